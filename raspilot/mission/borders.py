"""The borders of a fence in metres: on which side of them a point is, and how far they are."""

import math
from collections.abc import Iterable
from itertools import pairwise
from operator import itemgetter
from typing import TypeAlias

from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import Border
from up.quick_dataclass import dataclass

ROUNDING_M2 = 1.0
_Edge: TypeAlias = tuple[Point, Point]


@dataclass(frozen=True, slots=True)
class LocalBorder:
    """A border in a LocalFrame: a circle, or with ``edges`` a polygon within that circle.

    A point is in a polygon whose edges cross each other if a way out of it crosses an odd number.
    """

    is_inside: bool
    centre: Point
    radius_m: float
    edges: tuple[_Edge, ...] = ()

    def most_m(self, point: Point) -> float:
        """Return an upper limit of ``depth_m``, which costs little; for a circle it is exact."""
        return self.radius_m - math.dist(point, self.centre)

    def depth_m(self, point: Point) -> float:
        """Return how far within it a point is; negative: beside it."""
        if not self.edges:
            return self.most_m(point)
        north, east = point
        nearest, is_within = math.inf, False
        for (north_1, east_1), (north_2, east_2) in self.edges:
            long_n, long_e = north_2 - north_1, east_2 - east_1
            n, e = north - north_1, east - east_1
            if (east_1 > east) != (east_2 > east) and n < long_n * e / long_e:
                is_within = not is_within
            square = long_n * long_n + long_e * long_e
            share = min(1.0, max(0.0, (n * long_n + e * long_e) / square)) if square else 0.0
            n, e = n - share * long_n, e - share * long_e
            nearest = min(nearest, n * n + e * e)
        return math.sqrt(nearest) if is_within else -math.sqrt(nearest)

    def cuts(self, a: Point, b: Point) -> Iterable[float]:
        """Yield the shares of the way from a to b at which it crosses the border."""
        way_n, way_e = b.north_m - a.north_m, b.east_m - a.east_m
        for (north_1, east_1), (north_2, east_2) in self.edges:
            long_n, long_e = north_2 - north_1, east_2 - east_1
            turn = way_n * long_e - way_e * long_n
            n, e = north_1 - a.north_m, east_1 - a.east_m
            if turn and 0.0 <= (n * way_e - e * way_n) / turn <= 1.0:
                yield (n * long_e - e * long_n) / turn
        square = way_n * way_n + way_e * way_e
        if not self.edges and square:
            n, e = a.north_m - self.centre.north_m, a.east_m - self.centre.east_m
            middle = -(n * way_n + e * way_e) / square
            inner = middle * middle - (n * n + e * e - self.radius_m**2) / square
            if inner > 0.0:
                yield from (middle - math.sqrt(inner), middle + math.sqrt(inner))

    @property
    def crosses_itself(self) -> bool:
        """Return whether edges of a polygon cross: its corners are in a wrong order."""
        edges, last = self.edges, len(self.edges) - 1
        return any(
            _cross(*edges[i], *edges[j]) for i in range(last) for j in range(i + 2, last + (i > 0))
        )

    def shows_all(self, point: Point) -> bool:
        """Return whether every straight way from a point within it to its border stays within."""
        north, east = point
        sides = {
            (n_2 - n_1) * (east - e_1) > (e_2 - e_1) * (north - n_1)
            for (n_1, e_1), (n_2, e_2) in self.edges
        }
        return len(sides) <= 1 and self.depth_m(point) >= 0.0


LocalBorders: TypeAlias = tuple[LocalBorder, ...]


def local_borders(borders: Iterable[Border], frame: LocalFrame) -> LocalBorders:
    """Convert the borders of a fence; once for each fence and frame."""
    return tuple(_local(each, frame) for each in borders)


def margin_m(borders: LocalBorders, point: Point) -> float:
    """Return how far a point is from the nearest place outside the fence; negative: outside.

    Where borders overlap it may be less than that, never more. Without borders it is infinite.
    """
    within = -math.inf if any(each.is_inside for each in borders) else math.inf
    for each in borders:
        if each.is_inside and each.most_m(point) > within:
            within = max(within, each.depth_m(point))
    others = ((-each.most_m(point), each) for each in borders if not each.is_inside)
    for least, each in sorted(others, key=itemgetter(0)):
        if least >= within:
            break
        within = min(within, -each.depth_m(point))
    return within


def inside(borders: LocalBorders, point: Point) -> bool:
    """Return whether a point is inside the fence, or on its border."""
    return margin_m(borders, point) >= 0.0


def crosses(borders: LocalBorders, a: Point, b: Point) -> bool:
    """Return whether the straight way from a to b is outside the fence anywhere."""
    if margin_m(borders, a) > math.dist(a, b):
        return False
    shares = sorted(share for each in borders for share in each.cuts(a, b) if 0.0 < share < 1.0)
    ends = (0.0, *shares, 1.0)
    middles = ((one + other) / 2 for one, other in pairwise(ends))
    return not all(inside(borders, _between(a, b, share)) for share in (0.0, *middles, 1.0))


def leads_straight(borders: LocalBorders, home: Point) -> bool:
    """Return whether the straight way home from every point of the fence surely stays inside.

    False if home is outside, if a polygon has a corner that hides a part of it from home, or if the
    fence has a place to stay out of.
    """
    return all(each.is_inside and each.shows_all(home) for each in borders)


def _cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return whether the ways from a to b and from c to d cross, apart from their ends."""
    pairs = ((_side(a, b, c), _side(a, b, d)), (_side(c, d, a), _side(c, d, b)))
    # Not where all lie on one line but for the rounding.
    return all(min(each) < -ROUNDING_M2 and max(each) > ROUNDING_M2 for each in pairs)


def _side(a: Point, b: Point, point: Point) -> float:
    """Return on which side of the way from a to b a point is: above 0 to its right."""
    return (b.north_m - a.north_m) * (point.east_m - a.east_m) - (b.east_m - a.east_m) * (
        point.north_m - a.north_m
    )


def _between(a: Point, b: Point, share: float) -> Point:
    return Point(
        a.north_m + share * (b.north_m - a.north_m), a.east_m + share * (b.east_m - a.east_m)
    )


def _local(border: Border, frame: LocalFrame) -> LocalBorder:
    if border.corners is None:
        assert border.latitude_deg is not None
        assert border.longitude_deg is not None
        assert border.radius_m is not None
        centre = frame.point(border.latitude_deg, border.longitude_deg)
        return LocalBorder(border.is_inside, centre, border.radius_m)
    corners = [frame.point(*each) for each in border.corners]
    norths, easts = zip(*corners, strict=True)
    centre = Point((min(norths) + max(norths)) / 2, (min(easts) + max(easts)) / 2)
    radius_m = max(math.dist(centre, each) for each in corners)
    edges = tuple(zip(corners, [*corners[1:], corners[0]], strict=True))
    return LocalBorder(border.is_inside, centre, radius_m, edges)
