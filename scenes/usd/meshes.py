"""Meshes of USD → corners of triangles.

A subdivision surface is its cage, with smooth normals.
"""

from pxr import Gf, UsdGeom, Vt

# Corners of the faces of a cube, counter-clockwise seen from outside; bits of a corner say where it is along each axis.
CUBE = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


class Primvar:
    """Values for corners of faces, whatever they belong to; flattened."""

    def __init__(self, values, interpolation):
        self.values, self.interpolation = values, interpolation

    def at(self, face, corner, point):
        index = {"faceVarying": corner, "uniform": face, "constant": 0}.get(self.interpolation, point)
        return tuple(float(x) for x in self.values[index]) if index < len(self.values) else None


def normals(mesh, time):
    """Of the file, or `None`."""
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    if primvar and primvar.HasValue():
        return Primvar(primvar.ComputeFlattened(time), primvar.GetInterpolation())
    values = mesh.GetNormalsAttr().Get(time)
    return Primvar(values, mesh.GetNormalsInterpolation()) if values else None


def uvs(mesh, time):
    """Texture coordinates: `st`, or the first that the mesh has."""
    found = [p for p in UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithValues()
             if str(p.GetTypeName()) in ("texCoord2f[]", "float2[]", "texCoord2d[]")]
    found.sort(key=lambda p: p.GetPrimvarName() != "st")
    return Primvar(found[0].ComputeFlattened(time), found[0].GetInterpolation()) if found else None


def smooth(points, faces):
    """Normals of points, weighted by the areas of the faces around them."""
    sums = [Gf.Vec3d(0) for _ in points]
    for corners in faces:
        for b, c in zip(corners[1:], corners[2:]):
            a = corners[0]
            cross = Gf.Cross(Gf.Vec3d(points[b] - points[a]), Gf.Vec3d(points[c] - points[a]))
            for point in (a, b, c):
                sums[point] += cross
    return Primvar([n.GetNormalized() if n.GetLength() else Gf.Vec3d(0, 1, 0) for n in sums], "vertex")


def unit(n):
    length = sum(x * x for x in n) ** 0.5 if n else 0
    return tuple(x / length for x in n) if length else (0.0, 1.0, 0.0)


def triangles(mesh, time, faces=None):
    """Corners (position, normal, uv) of the triangles of a mesh, or of some of its faces."""
    points = mesh.GetPointsAttr().Get(time) or []
    counts, indices = mesh.GetFaceVertexCountsAttr().Get(time) or [], mesh.GetFaceVertexIndicesAttr().Get(time) or []
    left = mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
    holes = set(mesh.GetHoleIndicesAttr().Get(time) or [])
    wanted = None if faces is None else set(faces)
    starts, at = [], 0
    for count in counts:
        starts.append(at)
        at += count
    all_faces = [list(indices[s:s + n]) for s, n in zip(starts, counts)]
    normal, uv, sign = normals(mesh, time), uvs(mesh, time), 1
    if normal is None and mesh.GetSubdivisionSchemeAttr().Get() != UsdGeom.Tokens.none:
        # Turned as the corners are.
        normal, sign = smooth(points, all_faces), -1 if left else 1
    out = []
    for face, corners in enumerate(all_faces):
        if face in holes or wanted is not None and face not in wanted:
            continue

        def corner(k, face=face, corners=corners):
            point = corners[k]
            n = unit(normal.at(face, starts[face] + k, point)) if normal else None
            st = uv.at(face, starts[face] + k, point) if uv else None
            # Images begin at the bottom in USD, at the top in glTF.
            return (tuple(float(x) for x in points[point]), n and tuple(sign * x for x in n),
                    (st[0], 1 - st[1]) if st else None if uv is None else (0.0, 0.0))

        for k in range(1, len(corners) - 1):
            turned = (0, k + 1, k) if left else (0, k, k + 1)
            out += [corner(j) for j in turned]
    return out


def cube(size):
    """The corners of a cube around the origin."""
    half = size / 2
    points = [tuple(half if i >> k & 1 else -half for k in range(3)) for i in range(8)]
    return [(points[corners[k]], None, None) for corners in CUBE for k in (0, 1, 2, 0, 2, 3)]


def faces_of(mesh, time):
    """Lists of faces by the prim that says their material: subsets first, the mesh for the rest."""
    subsets = [UsdGeom.Subset(p) for p in mesh.GetPrim().GetChildren() if p.IsA(UsdGeom.Subset)]
    subsets = [s for s in subsets if s.GetFamilyNameAttr().Get() in ("materialBind", "", None)]
    if not subsets:
        return [(mesh.GetPrim(), None)]
    lists = [(s.GetPrim(), list(s.GetIndicesAttr().Get(time) or Vt.IntArray())) for s in subsets]
    taken = {face for _, faces in lists for face in faces}
    rest = [face for face in range(len(mesh.GetFaceVertexCountsAttr().Get(time) or [])) if face not in taken]
    return lists + ([(mesh.GetPrim(), rest)] if rest else [])
