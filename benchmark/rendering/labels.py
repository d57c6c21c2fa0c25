"""Positions of the labels of a scatter plot: near their points, without covering anything.

Each label has some hundred candidate boxes around its point. In turn, each takes its cheapest free
box while the others stay, a few times: a discrete gradient descent, as compared with others by
J. Christensen, J. Marks, S. Shieber (1995), An empirical study of algorithms for point-feature
label placement, ACM Transactions on Graphics 14(3):203-232.
"""

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
"""Boxes have shape (k, 4): left, top, right, bottom. Lengths are in one unit, such as pixels."""

DIRECTIONS: Final = 24
DISTANCES: Final = (0.6, 0.8, 1.2, 1.8, 2.6, 3.6, 5.0, 7.0, 9.5, 13.0, 18.0, 25.0)
"""Distances between a point and its label, in heights of the lowest label."""

COVERED: Final = 6.0
"""Cost of covering a line, in units of distance."""

CROSSED: Final = 30.0
"""Cost of a leader that crosses an obstacle or another label."""

PASSES: Final = 4
"""Largest number of turns of each label."""


def place_labels(
    points: ArrayLike,
    sizes: ArrayLike,
    *,
    obstacles: ArrayLike = (),
    lines: ArrayLike = (),
    bounds: ArrayLike,
) -> list[Array | None]:
    """Return a box for each label; None for one that has no free box.

    Parameters
    ----------
    points
        The points to which the labels belong, shape (n, 2); earlier points choose first.
    sizes
        Width and height of each label, shape (n, 2).
    obstacles
        Boxes that no label covers, such as markers, shape (m, 4).
    lines
        Boxes that labels cover only if the alternative is far away, shape (l, 4).
    bounds
        Box within which the labels stay, shape (4,).
    """
    anchors = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    extents = np.asarray(sizes, dtype=np.float64).reshape(-1, 2)
    fixed = np.asarray(obstacles, dtype=np.float64).reshape(-1, 4)
    thin = np.asarray(lines, dtype=np.float64).reshape(-1, 4)
    limits = np.asarray(bounds, dtype=np.float64)
    unit = float(extents[:, 1].min(initial=np.inf))
    candidates, costs = [], []
    for anchor, extent in zip(anchors, extents, strict=True):
        boxes, gaps = _candidates(anchor, extent, unit, limits)
        free = ~_covers(boxes, fixed).any(axis=1)
        boxes, gaps = boxes[free], gaps[free]
        others = fixed[~_covers(anchor[[0, 1, 0, 1]][None], fixed)[0]]
        crossed = _crossings(anchor, boxes, others)
        candidates.append(boxes)
        costs.append(gaps + COVERED * _covers(boxes, thin).sum(axis=1) + CROSSED * crossed)
    chosen: list[Array | None] = [None] * len(anchors)
    for _ in range(PASSES):
        for i, (anchor, boxes) in enumerate(zip(anchors, candidates, strict=True)):
            rest = [box for j, box in enumerate(chosen) if box is not None and j != i]
            others = np.reshape(rest, (-1, 4))
            cost = costs[i] + CROSSED * _crossings(anchor, boxes, others)
            cost[_covers(boxes, others).any(axis=1)] = np.inf
            some = bool(np.isfinite(cost).any())
            chosen[i] = boxes[cost.argmin()] if some else None
    return chosen


def nearest(box: Array, point: ArrayLike) -> Array:
    """Return the place in a box that is nearest to a point: the end of a leader."""
    end: Array = np.clip(point, box[:2], box[2:])
    return end


def _candidates(point: Array, size: Array, unit: float, bounds: Array) -> tuple[Array, Array]:
    """Return the boxes that a label may take, shape (k, 4), and their distances, shape (k,).

    The near ones come first, and among them those at the right, where one reads on.
    """
    angles = -2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    # From the middle of the box to its edge, in each direction.
    edges = ways / np.abs(ways).max(axis=1, keepdims=True) * size / 2
    centres = np.concatenate([point + gap * unit * ways + edges for gap in DISTANCES])
    boxes = np.concatenate([centres - size / 2, centres + size / 2], axis=1)
    gaps = np.repeat(DISTANCES, DIRECTIONS)
    inside = np.all((boxes[:, :2] >= bounds[:2]) & (boxes[:, 2:] <= bounds[2:]), axis=1)
    return boxes[inside], gaps[inside]


def _covers(boxes: Array, others: Array) -> NDArray[np.bool_]:
    """Return whether each box overlaps each of the others, shape (k, m)."""
    left, top, right, bottom = boxes.T[:, :, None]
    covers: NDArray[np.bool_] = (
        (left < others[:, 2])
        & (others[:, 0] < right)
        & (top < others[:, 3])
        & (others[:, 1] < bottom)
    )
    return covers


def _crossings(point: Array, boxes: Array, others: Array) -> Array:
    """Return the number of other boxes that the leader from the point to each box meets, (k,)."""
    way = nearest(boxes.T, point[:, None]).T - point
    way[np.abs(way) < 1e-9] = 1e-9
    # The parts of the leader, from 0 to 1, that lie between the sides of a box.
    low, high = ((others[:, i : i + 2] - point) / way[:, None, :] for i in (0, 2))
    enters, leaves = np.minimum(low, high), np.maximum(low, high)
    first = np.maximum(enters[..., 0], enters[..., 1])
    last = np.minimum(leaves[..., 0], leaves[..., 1])
    met: Array = (np.maximum(first, 0.0) <= np.minimum(last, 1.0)).sum(axis=1)
    return met
