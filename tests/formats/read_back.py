"""Reads the particle files of `globular simulate` with programs that are not ours, lets them write files of their own,
reads those with globular, and compares every value.

Usage: read_back.py GLOBULAR SCENE meshio|vtk|ase|lammps|openvdb

What is expected are the numbers of the double-precision PLY file, which this script takes apart by itself. Without the
program that is to read, it says so on a line that begins with "skipped: ", and succeeds.

OpenVDB reads the files of the metaballs' field, which has to be what this script sums up of the same particles.
"""

import json
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

FRAMES = (0, 7, 14)
RATE = 30  # frames a second
GLOBULAR = sys.argv[1]


def particles_of(path):
    """The particles of a double-precision PLY file, as a dictionary from the name of a property to its values."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    lines = [line.split() for line in header.decode().splitlines()]
    assert ["format", "binary_little_endian", "1.0"] in lines, lines
    count = next(int(line[2]) for line in lines if line[:2] == ["element", "vertex"])
    properties = [line[1:] for line in lines if line[0] == "property"]
    codes = {"double": "d", "float": "f", "uint": "I", "int": "i"}
    row = struct.Struct("<" + "".join(codes[kind] for kind, _ in properties))
    assert len(data) == count * row.size, (len(data), count)
    columns = list(zip(*row.iter_unpack(data))) or [()] * len(properties)
    return {name: list(column) for (_, name), column in zip(properties, columns)}


def single(values):
    """Numbers as single precision has them."""
    return [struct.unpack("<f", struct.pack("<f", value))[0] for value in values]


def check_equal(what, found, expected):
    found, expected = [float(x) for x in found], [float(x) for x in expected]
    assert len(found) == len(expected), f"{what}: {len(found)} values, expected {len(expected)}"
    for index, (here, there) in enumerate(zip(found, expected)):
        assert here == there, f"{what}: particle {index} has {here!r}, expected {there!r}"


def check_vectors(what, vectors, particles, prefix, rounded=lambda values: values):
    for axis, name in enumerate("xyz"):
        check_equal(f"{what} {prefix}{name}", [v[axis] for v in vectors], rounded(particles[prefix + name]))


def read_by_globular(folder, name, message=""):
    """The particles that globular makes of a file, or its error if one with this message is expected."""
    scene = folder / "again.toml"
    materials = "".join(f'[[material]]\nname = "{k}"\n' for k in range(3))
    scene.write_text(f'title = "again"\nduration = 1\n{materials}[[body]]\nshape = "file"\nfile = "{name}"\n')
    states = folder / "again"
    command = [GLOBULAR, "simulate", scene, "--frames", "0", "-o", states, "--overwrite", "--quiet"]
    result = subprocess.run(command, capture_output=True, text=True)
    if message:
        assert result.returncode == 2 and message in result.stderr, result.stderr
        return None
    assert result.returncode == 0, result.stderr
    return particles_of(states / "particles-00000.ply")


def check_read(what, folder, name, particles, properties, rounded=lambda values: values):
    found = read_by_globular(folder, name)
    for each in properties:
        check_equal(f"{what}, read by globular, {each}", found[each], rounded(particles[each]))


ALL = ("x", "y", "z", "vx", "vy", "vz", "radius", "mass", "material")


def check_meshio(folder, frame, particles):
    import meshio

    mesh = meshio.read(folder / f"particles-{frame:05}.ply")
    check_vectors("ply", mesh.points, particles, "")
    for name in set(particles) - set("xyz"):
        check_equal(f"ply {name}", mesh.point_data[name], particles[name])
    mesh = meshio.read(folder / f"particles-float-{frame:05}.ply")
    assert mesh.points.dtype == "float32", mesh.points.dtype
    check_vectors("ply-float", mesh.points, particles, "", single)
    for name in ("vx", "vy", "vz", "radius", "mass", "material", "id"):
        check_equal(f"ply-float {name}", mesh.point_data[name], single(particles[name]))
    mesh = meshio.read(folder / f"particles-{frame:05}.ply")
    for binary in (False, True):
        meshio.ply.write(folder / "meshio.ply", mesh, binary=binary)
        check_read("meshio's ply", folder, "meshio.ply", particles, ALL)


def check_vtk(folder, frame, particles):
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

    def rows(array):
        return [array.GetTuple(index) for index in range(array.GetNumberOfTuples())]

    reader = vtkXMLPolyDataReader()
    name = folder / f"particles-{frame:05}.vtp"
    reader.SetFileName(str(name))
    reader.Update()
    data = reader.GetOutput()
    count = len(particles["x"])
    assert reader.GetErrorCode() == 0 and data.GetNumberOfPoints() == count, data.GetNumberOfPoints()
    assert data.GetNumberOfVerts() == data.GetNumberOfCells() == count
    for index in range(count):
        cell = data.GetCell(index)
        assert cell.GetNumberOfPoints() == 1 and cell.GetPointId(0) == index
    check_vectors("vtp", [data.GetPoint(index) for index in range(count)], particles, "")
    point_data = data.GetPointData()
    check_vectors("vtp", rows(point_data.GetArray("velocity")), particles, "v")
    for array in ("radius", "mass", "id", "material"):
        check_equal(f"vtp {array}", [row[0] for row in rows(point_data.GetArray(array))], particles[array])
    colors = [(0xC0, 0x30, 0x20), (0x20, 0x60, 0xFF), (0x20, 0x60, 0xFF)]
    assert rows(point_data.GetArray("color")) == [colors[material] for material in particles["material"]]
    fields = data.GetFieldData()
    check_equal("vtp TimeValue", rows(fields.GetArray("TimeValue"))[0], [frame / RATE])
    check_equal("vtp frame", rows(fields.GetArray("frame"))[0], [frame])
    names = fields.GetAbstractArray("material_names")
    assert [names.GetValue(k) for k in range(2)] == ['red "drops"', "powder"], names.GetValue(0)
    run = json.loads((folder / "run.json").read_text())
    assert fields.GetAbstractArray("simulation_hash").GetValue(0) == run["simulation_hash"]
    series = json.loads((folder / "particles.vtp.series").read_text())
    assert {"name": name.name, "time": frame / RATE} in series["files"], series

    for mode, is_encoded in (("Ascii", 0), ("Binary", 0), ("Appended", 0), ("Appended", 1)):
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(folder / "vtk.vtp"))
        writer.SetInputData(data)
        getattr(writer, f"SetDataModeTo{mode}")()
        writer.SetEncodeAppendedData(is_encoded)
        writer.SetHeaderTypeToUInt32()
        writer.Write()
        read_by_globular(folder, "vtk.vtp", "is compressed; save it without compression" if mode != "Ascii" else "")
        writer.SetCompressorTypeToNone()
        writer.Write()
        check_read(f"vtk's vtp ({mode})", folder, "vtk.vtp", particles, ALL)
        writer.SetByteOrderToBigEndian()
        writer.Write()
        check_read(f"vtk's vtp ({mode}, big-endian)", folder, "vtk.vtp", particles, ALL)

    reader = vtkPLYReader()
    reader.SetFileName(str(folder / f"particles-float-{frame:05}.ply"))
    reader.Update()
    data = reader.GetOutput()
    check_vectors("ply-float", [data.GetPoint(k) for k in range(data.GetNumberOfPoints())], particles, "", single)


def check_ase(folder, frame, particles):
    import ase.io

    atoms = ase.io.read(folder / f"particles-{frame:05}.xyz", format="extxyz")
    check_vectors("extxyz", atoms.get_positions(), particles, "")
    check_vectors("extxyz", atoms.arrays["velo"], particles, "v")
    for name in ("radius", "mass", "id", "material"):
        check_equal(f"extxyz {name}", atoms.arrays[name], particles[name])
    assert atoms.info["Time"] == frame / RATE and atoms.info["frame"] == frame, atoms.info
    assert not atoms.pbc.any() and atoms.cell.rank == 0
    assert atoms.arrays["color"].shape == (len(atoms), 3)
    # ASE writes eight decimals.
    ase.io.write(folder / "ase.xyz", [atoms, atoms], format="extxyz")
    check_read("ase's extxyz", folder, "ase.xyz", particles, ALL, lambda values: [float(f"{v:.8f}") for v in values])


def lammps_columns(folder, frame, charge):
    """The columns that LAMMPS writes of what it has read. It takes no more than a charge beside positions and
    velocities, so another column is read as one.
    """
    written = folder / "again.lammpstrj"
    script = folder / "in.lammps"
    script.write_text(
        "units si\natom_style charge\nboundary f f f\nregion box block -20 20 -20 20 -20 20\ncreate_box 3 box\n"
        f"read_dump {folder}/particles-{frame:05}.lammpstrj {frame} x y z vx vy vz q label q {charge} box no add keep\n"
        f"write_dump all custom {written} id type x y z vx vy vz q modify sort id format float %.17g\n"
    )
    subprocess.run(["lmp", "-in", script, "-log", "none", "-screen", "none"], check=True, cwd=folder)
    lines = written.read_text().splitlines()
    assert int(lines[lines.index("ITEM: TIMESTEP") + 1]) == frame
    start = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    return dict(zip(lines[start].split()[2:], zip(*(line.split() for line in lines[start + 1 :]))))


def check_lammps(folder, frame, particles):
    for charge in ("radius", "mass"):
        columns = lammps_columns(folder, frame, charge)
        check_equal(f"lammps {charge}", columns["q"], particles[charge])
    check_read("lammps' dump", folder, "again.lammpstrj", particles, ("x", "y", "z", "vx", "vy", "vz", "material"))
    check_equal("lammps id", columns["id"], [index + 1 for index in particles["id"]])
    check_equal("lammps type", columns["type"], [index + 1 for index in particles["material"]])
    for name in ("x", "y", "z", "vx", "vy", "vz"):
        check_equal(f"lammps {name}", columns[name], particles[name])


def check_openvdb(folder, frame, particles):
    import numpy
    import pyopenvdb

    name = str(folder / f"particles-{frame:05}.vdb")
    assert [grid.name for grid in pyopenvdb.readAllGridMetadata(name)] == ["density"]
    grid = pyopenvdb.read(name, "density")
    run = json.loads((folder / "run.json").read_text())
    assert grid.gridClass == pyopenvdb.GridClass.FOG_VOLUME and grid.background == 0
    assert grid["frame"] == frame and grid["time"] == frame / RATE, grid.metadata
    assert grid["scene_hash"] == run["scene_hash"], grid.metadata
    reach = 2.5  # look.metaball_reach
    assert abs(grid["iso_value"] - (1 - 1 / reach**2) ** 2) < 1e-6, grid["iso_value"]
    cell = grid.transform.voxelSize()[0]
    assert abs(cell - 0.5 * 0.08) < 1e-9, cell  # of the smallest particles

    low, high = (numpy.array(corner) for corner in grid.evalActiveVoxelBoundingBox())
    low, high = low - 2, high + 2
    values = numpy.zeros(high - low + 1, dtype=numpy.float32)
    grid.copyToArray(values, ijk=tuple(int(corner) for corner in low))
    expected = numpy.zeros(values.shape)
    for x, y, z, radius in zip(*(particles[key] for key in ("x", "y", "z", "radius"))):
        # The nodes around the particle, as far as its kernel reaches.
        ranges = []
        for center, first, count in zip((x, y, z), low, values.shape):
            nearest = [int(numpy.floor((center + side * reach * radius) / cell)) - first for side in (-1, 1)]
            ranges.append(slice(max(nearest[0], 0), min(nearest[1] + 2, count)))
        axes = [
            (cell * (numpy.arange(part.start, part.stop) + first) - center) ** 2
            for part, first, center in zip(ranges, low, (x, y, z))
        ]
        squared = axes[0][:, None, None] + axes[1][None, :, None] + axes[2][None, None, :]
        expected[tuple(ranges)] += numpy.maximum(0, 1 - squared / (reach * radius) ** 2) ** 2
    off = numpy.abs(values - expected)
    worst = numpy.unravel_index(off.argmax(), off.shape)
    # Single precision: positions of some meters are off by 2e-7 m, of kernels that fall by 1.6 within 0.2 m.
    assert off.max() < 1e-4, f"node {worst + low} has {values[worst]}, expected {expected[worst]}"
    assert grid.activeVoxelCount() == (values > 0).sum(), (grid.activeVoxelCount(), (values > 0).sum())
    assert (expected > grid["iso_value"]).sum() > 1000


def is_there(reader):
    if reader == "lammps":
        return shutil.which("lmp") is not None
    module = {"vtk": "vtkmodules.vtkIOXML", "ase": "ase.io", "openvdb": "pyopenvdb"}.get(reader, reader)
    return subprocess.run([sys.executable, "-c", f"import {module}"], capture_output=True).returncode == 0


def main():
    scene, reader = sys.argv[2:]
    if not is_there(reader):
        print(f"skipped: there is no {reader} here to read particle files with")
        return
    formats = "ply,ply-float,vtp,extxyz,lammps"
    if reader == "openvdb":
        formats = "ply,vdb"
        if "without OpenVDB" in subprocess.run([GLOBULAR, "--version"], check=True, capture_output=True, text=True).stdout:
            print("skipped: the program is built without OpenVDB")
            return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        frames = ",".join(str(frame) for frame in FRAMES)
        command = [GLOBULAR, "simulate", scene, "--frames", frames, "--format", formats, "-o", folder, "--quiet"]
        subprocess.run(command, check=True)
        radii, materials = set(), set()
        for frame in FRAMES:
            particles = particles_of(folder / f"particles-{frame:05}.ply")
            globals()[f"check_{reader}"](folder, frame, particles)
            radii.update(particles["radius"])
            materials.update(particles["material"])
            print(f"{reader}: frame {frame}, {len(particles['x'])} particles: equal")
        # What the scene is for; the particles are those of the last frame.
        assert any(b - a > 1 for a, b in zip(particles["id"], particles["id"][1:])), "the ids have no gaps"
        assert len(radii) > 1 and len(materials) > 1, (radii, materials)


main()
