"""Layers of `globular render --format`, read by other programs: FFmpeg and, where it is installed, OpenImageIO's oiiotool.

Usage: layer_readers_test.py PROGRAM. It needs python3-numpy; without it, it prints one line that starts with "skipped: ".
What is compared is one sphere before a background of two colors, whose depths and normals have a closed form.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

program = sys.argv[1]
WIDTH, HEIGHT = 64, 48
EYE, RADIUS, FOV = 3.0, 0.5, 40.0
TOP, BOTTOM = numpy.array([0.9, 0.8, 0.7]), numpy.array([0.1, 0.3, 0.5])
SCENE = f"""
title = "one"
duration = 1
[physics]
gravity = [0, 0, 0]
[material]
preset = "liquid"
radius = {RADIUS}
color = "#3366cc"
[[body]]
shape = "points"
positions = [[0, 0, 900], [0, 0, 0]]
[camera]
eye = [0, 0, {EYE}]
target = [0, 0, 0]
fov = {FOV}
[look]
style = "spheres"
background_top = {TOP.tolist()}
background_bottom = {BOTTOM.tolist()}
"""

failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


def png(path, pixel_format, channels, kind):
    """The samples of a PNG file, as FFmpeg reads them."""
    arguments = ["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", pixel_format, "-"]
    raw = subprocess.run(arguments, check=True, capture_output=True).stdout
    return numpy.frombuffer(raw, kind).reshape(HEIGHT, WIDTH, channels).astype(float)


def exr(path, channels, kind):
    """Channels of an OpenEXR file, as OpenImageIO reads them."""
    copy = path.with_suffix(".tif")
    subprocess.run(["oiiotool", "--native", path, "--ch", channels, "-d", kind, "-o", copy], check=True)
    dump = subprocess.run(["oiiotool", "--dumpdata", copy], check=True, capture_output=True, text=True).stdout
    rows = [re.sub(r"\(.*", "", line.split("): ")[1]).split() for line in dump.splitlines() if "): " in line]
    return numpy.array(rows, float).reshape(HEIGHT, WIDTH, -1)


def linear(srgb):
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def srgb(linear_):
    return numpy.where(linear_ <= 0.0031308, linear_ * 12.92, 1.055 * linear_ ** (1 / 2.4) - 0.055)


# The rays through the middles of the pixels: eye + depth (x, y, -1).
tangent = numpy.tan(numpy.radians(FOV / 2))
x = (2 * (numpy.arange(WIDTH) + 0.5) / WIDTH - 1) * tangent * WIDTH / HEIGHT
y = (1 - 2 * (numpy.arange(HEIGHT) + 0.5) / HEIGHT) * tangent
x, y = numpy.meshgrid(x, y)
square = x**2 + y**2 + 1
root = EYE**2 - square * (EYE**2 - RADIUS**2)
hit = root > 0
clear = numpy.abs(root) > 1e-3  # elsewhere rounding decides what is hit
depth = (EYE - numpy.sqrt(numpy.maximum(root, 0))) / square
normal = numpy.stack([x * depth, y * depth, EYE - depth], axis=-1) / RADIUS


def check_surface(name, found_depth, found_normal, depth_error, normal_error):
    """Compares depths and normals where the sphere is hit and does not lie edge-on."""
    inner = hit & clear
    expect(inner.sum() > 200, "too few pixels show the sphere")
    off = numpy.abs(found_depth - depth)[inner].max()
    expect(off <= depth_error, f"{name}: a depth is off by {off} m")
    off = numpy.abs(found_normal - normal)[inner].max()
    expect(off <= normal_error, f"{name}: a normal is off by {off}")


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "one.toml").write_text(SCENE)
    has_exr = "without OpenEXR" not in subprocess.run(
        [program, "--version"], check=True, capture_output=True, text=True
    ).stdout
    formats = "rgb,rgba,depth,normal,id" + (",exr" if has_exr else "")
    out = folder / "out"
    size = f"{WIDTH}x{HEIGHT}"
    subprocess.run(
        [program, "render", folder / "one.toml", "--frames", "0", "--size", size, "--quiet", "-o", out, "--format", formats],
        check=True,
    )
    step = json.loads((out / "run.json").read_text())["depth"]["meters_per_step"]
    expect(abs(step - 4 * EYE / 65535) < 1e-12, f"{step} m a step of depth")
    text = (out / "frame-00000.depth.png").read_bytes()
    expect(b"tEXtMetersPerStep\0%r" % step in text, "the depth picture does not say its scale")

    steps = png(out / "frame-00000.depth.png", "gray16be", 1, ">u2")[..., 0]
    expect((steps[~hit & clear] == 65535).all(), "depth: the background is not 65535")
    codes = png(out / "frame-00000.normal.png", "rgb48be", 3, ">u2")
    expect((codes[~hit & clear] == 0).all(), "normal: the background is not black")
    # Half a step each; single precision adds a tenth of that.
    check_surface("png", steps * step, codes / 32767.5 - 1, 0.6 * step, 1.6 / 65535)
    ids = png(out / "frame-00000.id.png", "rgb48be", 3, ">u2")
    expect((ids[..., 0] == numpy.where(hit, 2, 0))[clear].all(), "id: not that of the second particle")
    expect((ids[..., 1:] == 0).all(), "id: green and blue")

    rgba = png(out / "frame-00000.rgba.png", "rgba", 4, "u1") / 255
    picture = png(out / "frame-00000.png", "rgb24", 3, "u1")
    expect(set(numpy.unique(rgba[..., 3] * 4).round(1)) == {0, 1, 2, 3, 4}, "rgba: alpha is not of four samples")
    t = ((numpy.arange(HEIGHT) + 0.5) / HEIGHT)[:, None, None]
    alpha = rgba[..., 3:]
    over = linear(rgba[..., :3]) * alpha + (1 - alpha) * (TOP * (1 - t) + BOTTOM * t)
    off = numpy.abs(srgb(over) * 255 - picture).max()
    # Half a step each of color, alpha and picture, and the slope of the background within a pixel.
    expect(off < 2.5, f"rgba over the background is {off} steps of 255 from the picture")
    print(f"rgba over the background: within {off:.2f} steps of 255 of the picture")

    if not has_exr:
        print("without OpenEXR: the program is built without it")
    elif not shutil.which("oiiotool"):
        print("without OpenImageIO: there is no oiiotool")
    else:
        path = out / "frame-00000.exr"
        z = exr(path, "Z", "float")[..., 0]
        expect((z[~hit & clear] == 1e10).all(), "exr: Z of the background is not 1e10")
        check_surface("exr", z, exr(path, "N.X,N.Y,N.Z", "float"), 2e-5, 1e-4)
        expect((exr(path, "id", "uint32") == ids[..., :1]).all(), "exr: other ids than in the PNG file")
        premultiplied = exr(path, "R,G,B,A", "float")
        expect((premultiplied[..., 3:] == numpy.round(alpha * 4) / 4).all(), "exr: another alpha than in the PNG file")
        # Half a step of 255 at most, where the curve of sRGB is steepest in linear values.
        off = numpy.abs(premultiplied[..., :3] - linear(rgba[..., :3]) * numpy.round(alpha * 4) / 4).max()
        expect(off < 0.5 / 255 * 2.3, f"exr: a color is {off} from that of the PNG file")

if failures:
    print("\n".join(failures))
    sys.exit(1)
print("the layers are read as they were drawn")
