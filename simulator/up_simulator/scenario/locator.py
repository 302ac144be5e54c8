"""Locates a value in the tree of a file."""

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


def locate(node: Node, *path: str | int) -> Node:
    """Return the node that a path of keys and numbers leads to, or the deepest one on the way."""
    for step in path:
        below: Node | None
        if isinstance(step, int):
            exists = isinstance(node, ListNode) and step < len(node.items)
            below = node.items[step] if exists and isinstance(node, ListNode) else None
        else:
            below = child(node, step)
        if below is None:
            return node
        node = below
    return node


def path_of(node: Node, target: Node) -> str:
    """Return how problems call a node below ``node``: ``sticks[0].mode``; empty where it is not."""
    below: list[tuple[str, Node]] = []
    if isinstance(node, MapNode):
        below = [(key.text, value) for key, value in node.pairs if isinstance(key, ScalarNode)]
    elif isinstance(node, ListNode):
        below = [(f"[{at}]", item) for at, item in enumerate(node.items)]
    for name, inner in below:
        if inner is target:
            return name
        if rest := path_of(inner, target):
            return f"{name}{rest}" if rest.startswith("[") else f"{name}.{rest}"
    return ""
