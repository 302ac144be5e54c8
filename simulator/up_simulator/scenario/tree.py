"""Finds a value's place in the tree of a file."""

from __future__ import annotations

from up.config.nodes import ListNode, MapNode, Node, ScalarNode


def child(node: Node | None, name: str) -> Node | None:
    """Return the first value of a key, where there is a map that has it."""
    if isinstance(node, MapNode):
        for key, value in node.pairs:
            if isinstance(key, ScalarNode) and key.text == name:
                return value
    return None


def items_of(node: Node | None, name: str) -> list[Node]:
    """Return the items of a key's list, where there is one."""
    found = child(node, name)
    return found.items if isinstance(found, ListNode) else []


def place(node: Node, *path: str | int) -> Node:
    """Return the node that a path of keys and numbers leads to, or the deepest one on the way."""
    for step in path:
        below: Node | None
        if isinstance(step, int):
            is_there = isinstance(node, ListNode) and step < len(node.items)
            below = node.items[step] if is_there and isinstance(node, ListNode) else None
        else:
            below = child(node, step)
        if below is None:
            return node
        node = below
    return node
