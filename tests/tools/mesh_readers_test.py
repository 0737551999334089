"""Meshes of `globular mesh`, read by other programs: meshio and, where it is installed, VTK.

Usage: mesh_readers_test.py PROGRAM. It needs python3-meshio; without it, or where the program has no OpenVDB, it prints
one line that starts with "skipped: ".
"""

import pathlib
import subprocess
import sys
import tempfile

try:
    import meshio
    import numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

program = sys.argv[1]
if "without OpenVDB" in subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout:
    print("skipped: the program is built without OpenVDB")
    sys.exit(0)

CENTER = numpy.array([0.5, 1.25, -2.0])
RADIUS = 0.25
VELOCITY = numpy.array([1.0, -2.0, 3.0])
COLOR = numpy.array([0x33, 0x66, 0xCC])
SCENE = """
title = "one"
duration = 1
[physics]
gravity = [0, 0, 0]
[material]
preset = "liquid"
radius = 0.25
color = "#3366cc"
[[body]]
shape = "points"
positions = [[0.5, 1.25, -2.0]]
velocity = [1.0, -2.0, 3.0]
"""

failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


def check_sphere(name, points, triangles):
    """Checks that a mesh is a sphere around CENTER whose triangles face outward and are closed."""
    off = numpy.linalg.norm(points - CENTER, axis=1) - RADIUS
    expect(len(points) > 50, f"{name}: {len(points)} vertices")
    expect(numpy.abs(off).max() < 1e-6, f"{name}: a vertex is {numpy.abs(off).max()} m off the sphere")
    a, b, c = (points[triangles[:, k]] - CENTER for k in range(3))
    volume = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6
    sphere = 4 / 3 * numpy.pi * RADIUS**3
    # Triangles with sides of half a radius cut off about a tenth.
    expect(0.85 * sphere < volume < sphere, f"{name}: volume {volume} of {sphere}")
    edges = numpy.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    counts = numpy.unique(edges, axis=0, return_counts=True)[1]
    expect((counts == 2).all(), f"{name}: edges with other than two triangles")


def columns(mesh, names):
    return numpy.column_stack([mesh.point_data[name] for name in names])


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "one.toml").write_text(SCENE)
    for form in ("ply", "obj"):
        subprocess.run(
            [program, "mesh", folder / "one.toml", "--format", form, "--frames", "0", "--quiet", "-o", folder / form],
            check=True,
        )
    ply_file = folder / "ply" / "mesh-00000.ply"

    ply = meshio.read(ply_file)
    points = ply.points.astype(float)
    triangles = ply.cells_dict["triangle"].astype(int)
    check_sphere("ply", points, triangles)
    normals = columns(ply, ("nx", "ny", "nz"))
    expect(numpy.abs(normals - (points - CENTER) / RADIUS).max() < 1e-5, "ply: normals")
    expect(numpy.abs(columns(ply, ("vx", "vy", "vz")) - VELOCITY).max() < 1e-6, "ply: velocities")
    # meshio reads uchar as signed.
    colors = columns(ply, ("red", "green", "blue")).astype(int) & 255
    expect((colors == COLOR).all(), "ply: colors")

    text = (folder / "obj" / "mesh-00000.obj").read_text().splitlines()
    rows = numpy.array([line.split()[1:] for line in text if line.startswith("v ")], dtype=float)
    expect(numpy.abs(rows[:, 3:] * 255 - COLOR).max() < 0.05, "obj: colors")
    # meshio takes no colors after the positions.
    plain = folder / "plain.obj"
    plain.write_text("\n".join(" ".join(line.split()[:4]) if line.startswith("v ") else line for line in text) + "\n")
    obj = meshio.read(plain)
    check_sphere("obj", obj.points, obj.cells_dict["triangle"])
    expect((obj.points.astype(numpy.float32) == points).all(), "obj: positions other than those of the ply")
    expect((obj.cells_dict["triangle"] == triangles).all(), "obj: triangles other than those of the ply")

    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOGeometry import vtkOBJReader
        from vtkmodules.vtkIOPLY import vtkPLYReader
    except ImportError as error:
        print(f"without VTK: {error}")
    else:
        for name, reader in ((ply_file, vtkPLYReader()), (folder / "obj" / "mesh-00000.obj", vtkOBJReader())):
            reader.SetFileName(str(name))
            reader.Update()
            read = reader.GetOutput()
            there = vtk_to_numpy(read.GetPoints().GetData()).astype(float)
            cells = vtk_to_numpy(read.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
            check_sphere(f"VTK, {name.suffix}", there, cells)
            expect((there == points).all(), f"VTK, {name.suffix}: positions")

if failures:
    print("\n".join(failures))
    sys.exit(1)
print("the meshes are read as they were written")
