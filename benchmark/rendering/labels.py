"""Label placement in a scatter plot: near their points, and over nothing else.

Each label has some hundred places around its point. In turn, each moves to its cheapest place while
the others stay, until none moves: a discrete gradient descent, as compared with others by
J. Christensen, J. Marks, S. Shieber (1995), An empirical study of algorithms for point-feature
label placement, ACM Transactions on Graphics 14(3):203-232.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
"""Boxes have shape (k, 4): left, bottom, right, top. Lengths are in one unit, such as pixels."""

DIRECTIONS: Final = 24
DISTANCES: Final = (0.6, 0.8, 1.0, 1.6, 2.4, 3.4, 4.6, 6.0, 8.0, 10.0, 13.0)
"""Distances between a point and its label, in heights of the lowest label."""

OVER_LABEL: Final = 1000.0
OVER_OBSTACLE: Final = 100.0
CROSSED: Final = 30.0
"""What a label costs for lying over another or over an obstacle, and what its line to its point
costs for each label or point it crosses; to compare with its distance."""

STARTS: Final = 8
"""Descents, each with the labels in another order; the cheapest counts."""

PASSES: Final = 30
"""Longest descent: so many turns of each label."""


def place_labels(
    points: ArrayLike, sizes: ArrayLike, *, obstacles: ArrayLike = (), bounds: ArrayLike
) -> Array:
    """Return a box for each label.

    Parameters
    ----------
    points
        The points that the labels belong to, shape (n, 2).
    sizes
        Width and height of each label, shape (n, 2).
    obstacles
        Boxes that should stay free, such as markers, shape (m, 4).
    bounds
        Box that the labels stay within, shape (4,).

    Returns
    -------
    array
        Boxes of the labels, shape (n, 4). They overlap only if there is no room to avoid it.
    """
    anchors = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    extents = np.asarray(sizes, dtype=np.float64).reshape(-1, 2)
    fixed = np.asarray(obstacles, dtype=np.float64).reshape(-1, 4)
    limits = np.asarray(bounds, dtype=np.float64)
    unit = float(extents[:, 1].min(initial=np.inf))
    places, alone = [], []
    for anchor, extent in zip(anchors, extents, strict=True):
        boxes, gaps = _places(anchor, extent, unit, limits)
        places.append(boxes)
        alone.append(_cost_alone(anchor, boxes, gaps, fixed, anchors, unit))
    best, least = [], math.inf
    for order in _orders(len(anchors)):
        chosen, cost = _descend(anchors, places, alone, order)
        if cost < least:
            best, least = chosen, cost
    return np.array([boxes[i] for boxes, i in zip(places, best, strict=True)]).reshape(-1, 4)


def _orders(labels: int) -> list[list[int]]:
    """Return the orders in which the labels take their turns: always the same ones."""
    rng = np.random.default_rng(0)
    return [list(range(labels))] + [rng.permutation(labels).tolist() for _ in range(STARTS - 1)]


def _descend(
    anchors: Array, places: list[Array], alone: list[Array], order: list[int]
) -> tuple[list[int], float]:
    """Return the place of each label that the descent ends in, and what they cost together."""
    chosen = [int(cost.argmin()) for cost in alone]
    for _ in range(PASSES):
        before = list(chosen)
        cost = 0.0
        for i in order:
            others = np.array([places[j][chosen[j]] for j in order if j != i]).reshape(-1, 4)
            lines = _crossings(anchors[i], places[i], others)
            over = (_overlaps(places[i], others) > 0).sum(axis=1)
            costs = alone[i] + OVER_LABEL * over + CROSSED * lines
            chosen[i] = int(costs.argmin())
            cost += float(costs[chosen[i]])
        if chosen == before:
            break
    return chosen, cost


def nearest(box: Array, point: Array) -> Array:
    """Return the place in a box that is nearest to a point: where its line ends."""
    end: Array = np.clip(point, box[:2], box[2:])
    return end


def _places(point: Array, size: Array, unit: float, bounds: Array) -> tuple[Array, Array]:
    """Return the boxes a label may take, shape (k, 4), and how far off each is, shape (k,).

    The near ones come first, and among them those at the right, where one reads on.
    """
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    # From the middle of the box to its edge, in each direction.
    edges = ways / np.abs(ways).max(axis=1, keepdims=True) * size / 2
    centres = np.concatenate([point + gap * unit * ways + edges for gap in DISTANCES])
    boxes = np.concatenate([centres - size / 2, centres + size / 2], axis=1)
    gaps = np.repeat(DISTANCES, DIRECTIONS)
    inside = np.all((boxes[:, :2] >= bounds[:2]) & (boxes[:, 2:] <= bounds[2:]), axis=1)
    return (boxes[inside], gaps[inside]) if inside.any() else (boxes, gaps)


def _cost_alone(
    point: Array, boxes: Array, gaps: Array, obstacles: Array, points: Array, unit: float
) -> Array:
    """Return what each place costs before the other labels are counted, shape (k,)."""
    covered = _overlaps(boxes, obstacles).sum(axis=1)
    others = points[np.any(points != point, axis=1)]
    dots = np.concatenate([others - unit / 4, others + unit / 4], axis=1)
    crossed = _crossings(point, boxes, dots)
    cost: Array = gaps + OVER_OBSTACLE * covered + CROSSED * crossed
    return cost


def _overlaps(boxes: Array, others: Array) -> Array:
    """Return the share of each box that each of the others covers, shape (k, m)."""
    low = np.maximum(boxes[:, None, :2], others[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], others[None, :, 2:])
    area = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    shared: Array = np.prod(np.clip(high - low, 0.0, None), axis=2) / area[:, None]
    return shared


def _crossings(point: Array, boxes: Array, others: Array) -> Array:
    """Return how many of the other boxes the line from the point to each box meets, shape (k,)."""
    way = np.clip(point, boxes[:, :2], boxes[:, 2:]) - point
    way[np.abs(way) < 1e-9] = 1e-9
    # The parts of the line, from 0 to 1, that lie between the sides of a box.
    sides = (others.reshape(-1, 2, 2) - point) / way[:, None, None, :]
    enters = sides.min(axis=2).max(axis=2)
    leaves = sides.max(axis=2).min(axis=2)
    met: Array = (np.maximum(enters, 0.0) <= np.minimum(leaves, 1.0)).sum(axis=1)
    return met
