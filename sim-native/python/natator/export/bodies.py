"""What a stream's scene says of its particles, and the bodies that they make up."""

import numpy as np

from natator.plain import is_number

KINDS = ("water", "body", "other")
#: of clusters, from the head on, again from the first after the last; linear red, green and blue
PALETTE = np.array([(0.894, 0.510, 0.176), (0.839, 0.278, 0.302), (0.741, 0.290, 0.573), (0.451, 0.373, 0.725),
                    (0.984, 0.737, 0.294)], "f4")
ROW_GAP = 0.25  # neighbours in a slice sit half a solid rest distance apart; rows are told apart by half of that
BONES_PER_VERTEX = 4


class Swim:
    """The constant properties of all particles, from a SCEN message.

    Attributes: `kind` (place in KINDS), `cluster` (of several the one nearest to the head, −1 without), `creature` (0 the swimmer,
    from 1 on companions, −1 none) and `mass` (infinite if held in place) of each particle; `shown`, `water`, `solids`: indices of
    what is exported; `triangles`: for each creature the corners of its surface, particles.
    """

    @classmethod
    def of(cls, stream, water=True):
        """Reads it from a new stream that sends positions. Raises Unstable, and ProgramError for a malformed scene."""
        stream.require_stable()
        try:
            return cls(stream.scene, stream.frame.position, water)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            raise stream.no_simulator() from None

    def __init__(self, scene, start, water=True):
        count, (first, fluid) = scene["particles"], scene["fluid"]
        self.scene = scene
        self.fields = scene["fields"]
        self.kind = np.full(count, KINDS.index("other"), "u1")
        self.kind[first:first + fluid] = KINDS.index("water")
        self.kind[scene["body"]] = KINDS.index("body")
        self.cluster = np.full(count, -1, "i4")
        for i, members in reversed(list(enumerate(scene["clusters"]))):
            self.cluster[members] = i
        self.creature = np.full(count, -1, "i4")
        for i, companion in enumerate(scene.get("companions") or [], 1):
            self.creature[companion["body"]] = i
        self.creature[scene["body"]] = 0
        self.mass = np.array([np.inf if mass is None else mass for mass in scene["mass"]], "f4")
        if self.mass.shape != (count,) or not (is_number(scene["solidRestDistance"]) and is_number(scene["fluidRestDistance"])):
            raise ValueError
        self.all_water = np.arange(first, first + fluid)
        self.water = self.all_water if water else np.empty(0, int)
        self.solids = np.flatnonzero(self.kind != 0)
        self.shown = np.arange(count) if water else self.solids
        slices = [scene["slices"], *(companion["slices"] for companion in scene.get("companions") or [])]
        self.triangles = [body_surface(one, start, ROW_GAP * scene["solidRestDistance"]) for one in slices]
        self.skin = scene.get("skin") and _skin(scene["skin"], len(scene["body"]), len(self.clusters_of(0)))
        self.muscle_ends = np.array([(muscle["a"], muscle["b"]) for muscle in scene["muscles"]], int).reshape(-1, 2)
        self.muscle_actuators, self.muscle_lateral, self.muscle_rest_length = (
            np.array([muscle[key] for muscle in scene["muscles"]], dtype)
            for key, dtype in (("actuator", "i4"), ("lateral", "f8"), ("restLength", "f8")))
        self.title = "".join(letter if letter.isprintable() else "?" for letter in
                             f"{scene['scene']}, Natator {(scene.get('program') or {}).get('version', '')}")

    def contraction(self, frame):
        """How much shorter than at rest each muscle wants to be, as a share; negative = longer."""
        return (-0.5 * self.muscle_lateral * frame.drive[self.muscle_actuators]).astype("f4")

    def places_in(self, shown, particles):
        """Index of each of these particles in a sorted list of particles."""
        return np.searchsorted(shown, particles).astype("i4")

    def surface_in(self, shown):
        """Triangles of all creatures, corners as places in a list of particles."""
        return self.places_in(shown, np.concatenate(self.triangles))

    def clusters_of(self, creature):
        """Particles of each cluster of a creature; of a creature without clusters, all of its particles."""
        own = [cluster for cluster in self.scene["clusters"] if cluster and self.creature[cluster[0]] == creature]
        return own or [np.flatnonzero(self.creature == creature)]

    def has_surface(self, creature):
        return len(self.triangles[creature]) > 0 or creature == 0 and self.skin is not None

    def surfaces(self):
        """Creatures that have a surface, by name."""
        return {f"Companion{i}" if i else "Body": i for i in range(len(self.triangles)) if self.has_surface(i)}


def _skin(skin, particles, clusters):
    """Its arrays. Raises ValueError and others if they do not fit a body of so many particles and clusters."""
    arrays = {key: np.array(skin[key], dtype) for key, dtype in (
        ("vertices", float), ("rest", float), ("share", float), ("triangles", int), ("cluster", int))}
    arrays["other"] = np.array(skin.get("other", arrays["cluster"] + 1), int)
    vertices, rest, share, triangles, cluster, other = arrays.values()
    count = len(vertices)
    fits = (vertices.shape == (count, 3) and rest.shape == (particles, 3) and share.shape == cluster.shape == other.shape == (count,)
            and triangles.shape == (len(triangles), 3) and ((0 <= triangles) & (triangles < count)).all()
            and ((0 <= cluster) & (cluster < clusters)).all() and ((0 <= share) & (share <= 1)).all()
            and ((0 <= other) & ((other < clusters) | (share == 1))).all() and np.isfinite(vertices).all() and np.isfinite(rest).all())
    if not fits:
        raise ValueError
    return arrays


def colours(clusters):
    """Of each cluster; that of the first for a particle without one."""
    return PALETTE[np.maximum(clusters, 0) % len(PALETTE)]


# --- the surface of slices --------------------------------------------------------------------------------------------


def body_surface(slices, position, gap):
    """Triangles (T, 3) around a body whose slices are rows of particles in (y, z), one above the other and each as far to the left
    as to the right: between the rims of neighbouring slices, and the first and the last slice. Seen from outside, corners go round
    counter-clockwise. None if slices are no such rows."""
    grids = [_grid(np.array(one, int), position, gap) for one in slices]
    triangles = []
    if len(grids) > 1 and all(grids):
        triangles += _cap(grids[0], True)
        for front, rear in zip(grids, grids[1:]):
            triangles += _join(_rim(front), _rim(rear))
        triangles += _cap(grids[-1], False)
    return np.array([one for one in triangles if len(set(one)) == 3], int).reshape(-1, 3)


def _grid(particles, position, gap):
    """Rows from the bottom to the top, each from the left to the right; None if the slice does not consist of such: rows widen to
    the middle and narrow again, as far below as above it, if they differ at all."""
    if not len(particles):
        return None
    particles = particles[np.argsort(position[particles, 1], kind="stable")]
    rows = np.split(particles, np.flatnonzero(np.diff(position[particles, 1].astype(float)) > gap) + 1)
    rows = [row[np.argsort(position[row, 2], kind="stable")].tolist() for row in rows]
    sizes = [len(row) for row in rows]
    half = sizes[:(len(sizes) + 1) // 2]
    rounded = sizes == sizes[::-1] and half == sorted(half) and all((size - sizes[0]) % 2 == 0 for size in sizes)
    return rows if rounded else None


def _rim(grid):
    """Along the bottom to the right, up, along the top to the left, and down; each particle with its place on the way round, a side
    from 0 to 1 after the other."""
    sides = [grid[0], [row[-1] for row in grid], grid[-1][::-1], [row[0] for row in reversed(grid)]]
    rim = [(side + i / (len(row) - 1), particle) for side, row in enumerate(sides) for i, particle in enumerate(row[:-1])]
    return rim or [(0, grid[0][0])]


def _join(front, rear):
    """Triangles between two rims, advancing on the rim whose next particle comes first."""
    ends = [rim + [(4 + rim[0][0], rim[0][1])] for rim in (front, rear)]
    (front, rear), i, j = ends, 0, 0
    while i < len(front) - 1 or j < len(rear) - 1:
        if j == len(rear) - 1 or i < len(front) - 1 and front[i + 1][0] <= rear[j + 1][0]:
            yield front[i][1], front[i + 1][1], rear[j][1]
            i += 1
        else:
            yield front[i][1], rear[j + 1][1], rear[j][1]
            j += 1


def _cap(grid, front):
    for row, above in zip(grid, grid[1:]):
        beyond = (len(row) - len(above)) // 2
        low, high = row[max(beyond, 0):len(row) - max(beyond, 0)], above[max(-beyond, 0):len(above) - max(-beyond, 0)]
        for a, b, c, d in zip(low, low[1:], high, high[1:]):
            yield from ((b, a, c), (b, c, d)) if front else ((a, b, d), (a, d, c))
        for wide, other, right in ((row, above, not front), (above, row, front)):
            for i in range(max(len(wide) - len(other), 0) // 2):  # what is further left, or right, than all of the other row
                for end, a, b in ((other[0], wide[i], wide[i + 1]), (other[-1], wide[-2 - i], wide[-1 - i])):
                    yield (end, a, b) if right else (end, b, a)


# --- bodies with bones ------------------------------------------------------------------------------------------------


def motion(rest, now):
    """The rigid motion that brings a cluster's particles nearest to where they are (Kabsch 1976): turned by a matrix of determinant 1
    about a place, which goes to another."""
    centre, to = rest.mean(0), now.mean(0)
    u, _, v = np.linalg.svd((now - to).T @ (rest - centre))
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v, centre, to


def quaternion(turn):
    """x, y, z, w of a rotation matrix (Bar-Itzhack 2000): the eigenvector of the largest eigenvalue."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn
    return np.linalg.eigh([[xx - yy - zz, xy + yx, xz + zx, zy - yz], [xy + yx, yy - xx - zz, yz + zy, xz - zx],
                           [xz + zx, yz + zy, zz - xx - yy, yx - xy], [zy - yz, xz - zx, yx - xy, xx + yy + zz]])[1][:, -1]


class Rig:
    """A creature's surface and the clusters that move it, as a mesh with bones: its skin if it is the swimmer and has one, else the
    surface of its slices. Each vertex follows up to BONES_PER_VERTEX clusters by shares.

    Attributes: `vertices` (V, 3) at rest, `triangles` (T, 3), `cluster` of each vertex, `bones` and `shares` (V, 4).
    """

    def __init__(self, swim, creature, start):
        self._clusters = [np.array(cluster) for cluster in swim.clusters_of(creature)]
        if creature == 0 and swim.skin:
            self.vertices, rest, share, self.triangles, self.cluster, other = swim.skin.values()
            self._rest = np.zeros((swim.scene["particles"], 3))
            self._rest[swim.scene["body"]] = rest
            follows = np.zeros((len(self.vertices), len(self._clusters) + 1))
            each = np.arange(len(self.vertices))
            follows[each, self.cluster] = share
            follows[each, other] += 1 - share
        else:
            self._rest = start.astype(float)
            used, triangles = np.unique(swim.triangles[creature], return_inverse=True)
            self.vertices, self.triangles = self._rest[used], triangles.reshape(-1, 3)
            follows = np.array([np.isin(used, cluster) for cluster in self._clusters], float).T
            follows[~follows.any(1), 0] = 1
            self.cluster = follows.argmax(1)
            follows /= follows.sum(1, keepdims=True)
        self.bones = np.argsort(follows == 0, axis=1, kind="stable")[:, :BONES_PER_VERTEX]
        self.shares = np.take_along_axis(follows, self.bones, 1)
        self.bones = np.pad(np.where(self.shares > 0, self.bones, 0), ((0, 0), (0, BONES_PER_VERTEX - self.bones.shape[1])))
        self.shares = np.pad(self.shares, ((0, 0), (0, BONES_PER_VERTEX - self.shares.shape[1])))

    def motions(self, position):
        """The rigid motion of each bone to where its particles are."""
        return [motion(self._rest[cluster], position[cluster].astype(float)) for cluster in self._clusters]

    def places(self, position):
        """Where the vertices are, blended linearly between the motions of their bones."""
        turns, centres, ends = (np.array(part)[self.bones] for part in zip(*self.motions(position)))
        moved = np.einsum("vkij,vkj->vki", turns, self.vertices[:, None] - centres) + ends
        return (self.shares[..., None] * moved).sum(1).astype("f4")

    def normals(self):
        """Normal of each vertex: mean of the outer normals of its triangles, weighted by area."""
        a, b, c = (self.vertices[self.triangles[:, i]] for i in range(3))
        sums = np.zeros_like(self.vertices)
        np.add.at(sums, self.triangles, np.cross(b - a, c - a)[:, None])
        length = np.linalg.norm(sums, axis=1, keepdims=True)
        return np.where(length > 0, sums / np.where(length > 0, length, 1), [0, 1, 0])
