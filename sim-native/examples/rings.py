"""Faces of a closed surface of rings of corners between two poles, for scripts that write meshes."""


def print_faces(rings, around):
    """For corners in this order: the first pole, so many rings of `around` corners each, the last pole."""
    def corner(ring, k):
        return 2 + ring * around + k % around

    for k in range(around):
        print(f"f 1 {corner(0, k + 1)} {corner(0, k)}")
        for ring in range(rings - 1):
            print(f"f {corner(ring, k)} {corner(ring, k + 1)} {corner(ring + 1, k + 1)} {corner(ring + 1, k)}")
        print(f"f {corner(rings, 0)} {corner(rings - 1, k)} {corner(rings - 1, k + 1)}")
