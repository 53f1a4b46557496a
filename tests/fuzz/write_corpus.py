#!/usr/bin/env python3
# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the seeds of tests/fuzz/corpus: one small file for each way that a reader can go. The same bytes every time.

Suites and cases have further seeds: the shipped suites and the atlas (see CMakeLists.txt)."""
import base64
import gzip
import json
import os
import struct

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.5)]


def put(target: str, name: str, data: str | bytes) -> None:
    os.makedirs(os.path.join(HERE, target), exist_ok=True)
    with open(os.path.join(HERE, target, name), "wb") as file:
        file.write(data.encode() if isinstance(data, str) else data)


def ply_header(form: str, real: str, length: str, index: str, faces: int, vertex_more: str = "") -> str:
    return (
        f"ply\nformat {form} 1.0\ncomment c\nelement vertex 4\nproperty {real} x\nproperty {real} y\n"
        f"property {real} z\n{vertex_more}element face {faces}\nproperty list {length} {index} vertex_indices\nend_header\n"
    )


def ply() -> None:
    xyz = "".join(f"{x} {y} {z}\n" for x, y, z in SQUARE)
    put("ply", "text.ply", ply_header("ascii", "double", "uchar", "int", 2) + xyz + "3 0 1 2\n3 0 2 3\n")
    put("ply", "text_quad_crlf.ply", (ply_header("ascii", "float", "uint8", "uint16", 1) + xyz + "4 0 1 2 3\n").replace("\n", "\r\n"))
    put("ply", "text_not_finite.ply", ply_header("ascii", "float", "char", "int8", 1) + "nan 0 0\ninf 0 0\n-inf 1 1e-320\n1e308 1 0\n4 0 1 2 3\n")
    for mark, form in (("<", "binary_little_endian"), (">", "binary_big_endian")):
        for real, code in (("float", "f"), ("double", "d"), ("short", "h")):
            body = b"".join(struct.pack(mark + "3" + code, *(p if code != "h" else map(int, p))) for p in SQUARE)
            body += struct.pack(mark + "B3i", 3, 0, 1, 2) + struct.pack(mark + "B3i", 3, 0, 2, 3)
            put("ply", f"{form}_{real}.ply", ply_header(form, real, "uchar", "int", 2).encode() + body)
    more = "property uchar red\nproperty list ushort float w\n"
    body = b"".join(struct.pack("<3fBHff", *p, 7, 2, 1, 2) for p in SQUARE) + struct.pack("<I4B", 4, 0, 1, 2, 3)
    put("ply", "extra_properties.ply", ply_header("binary_little_endian", "float32", "uint", "uchar", 1, more).encode() + body)
    put("ply", "normals.ply", ply_header("ascii", "float", "uchar", "int", 1, "".join(f"property float n{c}\n" for c in "xyz")) + "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in SQUARE) + "4 0 1 2 3\n")
    put("ply", "other_elements.ply", "ply\nformat ascii 1.0\nobj_info i\nelement camera 1\nproperty int a\nelement none 9\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n5\n")


def obj() -> None:
    v = "".join(f"v {x} {y} {z}\n" for x, y, z in SQUARE)
    put("obj", "square.obj", f"# c\nmtllib a\no a\n{v}f 1 2 3\nf 1 3 4\n")
    put("obj", "forms.obj", f"{v}vt 0 0\nvn 0 0 1\nf -4 -3 -2\nf 1/1 3/1/1 4//1\nf 1 2\nf\nl 1 2\n")
    put("obj", "normals.obj", f"{v}vn 0 0 1\nvn 0 1 0\nvn 0 0 1\nf 1//1 2//2 3/7/3\nf 1//-1 3//1 4//1\n")
    put("obj", "concave.obj", "v 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4 5 6\n")
    put("obj", "standing.obj", "v 0 0 0\r\nv 0 2 0\r\nv 0 1 1\r\nv 0 2 2\r\nv 0 0 2\r\nf 1 2 3 4 5\r\nf 5 4 3 2 1")
    put("obj", "not_finite.obj", "v nan 0 -inf\nv 1e308 -1e308 0\nv 0 1e-320 +1\nv 1e308 1e308 1\nf 1 2 3 4\nf 2 3 4 2 3\n")


def off() -> None:
    v = "".join(f"{x} {y} {z}\n" for x, y, z in SQUARE)
    put("off", "square.off", f"OFF\n4 2 0\n{v}3 0 1 2\n3 0 2 3\n")
    put("off", "quad_colour.off", f"OFF # c\n\n4 1 5\n{v}4 0 1 2 3 255 0 0\n")
    put("off", "small_polygons.off", f"OFF 4 4 0 {v}0\n1 3\n2 0 1\n5 0 1 2 3 0")
    put("off", "empty.off", "OFF\n0 0 0\n")


def stl() -> None:
    def facet(a: int, b: int, c: int) -> str:
        corners = "".join("vertex {} {} {}\n".format(*SQUARE[k]) for k in (a, b, c))
        return f"facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n"

    put("stl", "square.stl", f"solid a b\n{facet(0, 1, 2)}{facet(0, 2, 3)}endsolid a b\n")
    put("stl", "two_solids.stl", f"solid\n{facet(0, 1, 2)}endsolid\nsolid b\n{facet(0, 2, 3)}endsolid b\n")
    put("stl", "empty.stl", "solid\nendsolid\n")
    for name, title, floats in (
        ("binary.stl", b"", [SQUARE[k] for k in (0, 1, 2, 0, 2, 3)]),
        ("binary_solid.stl", b"solid, but binary", [(0, 0, 0), (-0.0, 0, 1), (float("nan"), float("inf"), 1e-40)]),
    ):
        body = b"".join(struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *p) for p in floats[k : k + 3]) + b"\0\0" for k in range(0, len(floats), 3))
        put("stl", name, title.ljust(80, b"\0") + struct.pack("<I", len(floats) // 3) + body)


def gltf() -> None:
    points = b"".join(struct.pack("<3f", *p) for p in SQUARE)

    def glb(document: dict, binary: bytes) -> bytes:
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary += b"\0" * (-len(binary) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks

    def document(indices: bytes, component: int, mode: int | None, nodes: list, **more: object) -> tuple[dict, bytes]:
        size = {5121: 1, 5123: 2, 5125: 4}[component]
        primitive = {"attributes": {"POSITION": 0}, "indices": 1}
        if mode is not None:
            primitive["mode"] = mode
        return {
            "asset": {"version": "2.0"},
            "meshes": [{"primitives": [primitive]}],
            "nodes": nodes,
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": component, "count": len(indices) // size, "type": "SCALAR"},
            ],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": len(indices)}],
            "buffers": [{"byteLength": 48 + len(indices)}],
            **more,
        }, points + indices

    triangles = [0, 1, 2, 0, 2, 3]
    put("gltf", "bytes.glb", glb(*document(bytes(triangles), 5121, None, [{"mesh": 0}])))
    put("gltf", "words.glb", glb(*document(struct.pack("<6I", *triangles), 5125, 4, [{"mesh": 0}])))
    put("gltf", "strip.glb", glb(*document(struct.pack("<4H", 0, 1, 3, 2), 5123, 5, [{"mesh": 0}])))
    put("gltf", "fan.glb", glb(*document(struct.pack("<4H", 0, 1, 2, 3), 5123, 6, [{"mesh": 0}])))
    turned = [
        {"translation": [10, 0, 0], "children": [1, 2]},
        {"mesh": 0, "rotation": [0, 0, 0.7071, 0.7071], "scale": [2, 2, 2]},
        {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]},
    ]
    scenes = {"scene": 1, "scenes": [{"nodes": [1]}, {"nodes": [0]}]}
    put("gltf", "nodes.glb", glb(*document(struct.pack("<6H", *triangles), 5123, None, turned, **scenes)))
    text, binary = document(struct.pack("<6H", *triangles), 5123, None, [{"mesh": 0, "scale": [1, 2, 3]}])
    text["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 0
    put("gltf", "normals.glb", glb(text, binary))
    text, binary = document(bytes(triangles), 5121, None, [{"mesh": 0}], extensionsRequired=["KHR_mesh_quantization"])
    text["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    put("gltf", "inside.gltf", json.dumps(text))
    for component, code in ((5120, "b"), (5121, "B"), (5122, "h"), (5123, "H")):
        stride = 4 if code in "bB" else 8
        body = b"".join(struct.pack("<4" + code, x, y, z, 0) for x, y, z in ((0, 0, 0), (9, 0, 1), (0, 9, 2)))
        put("gltf", f"quantized_{code}{'u' if code.isupper() else ''}.glb", glb({
            "asset": {"version": "2.1"},
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": component, "normalized": code in "bH", "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 3 * stride, "byteStride": stride}],
            "buffers": [{"byteLength": 3 * stride}],
        }, body))


def pose() -> None:
    for name, text in (
        ("short", "1,2,3:4,5,6"),
        ("fov", "-1.5,+2,3e2:4,5,-6:0.5"),
        ("whole", "0.1,-1e-300,123456789.125:1e17,0,-0:33.3:640x480"),
        ("straight_down", "1,1,1000:1,1,0:90:2x2"),
        ("far", "1e300,0,0:-1e300,0,0"),
        ("near", "0,0,0:3e-162,0,0"),
        ("nearly_down", "0,0,0:1e-200,0,-1"),
        ("not_finite", "inf,nan,-inf:0,0,0"),
    ):
        put("pose", name, text)


def suite() -> None:
    put("suite", "everything.toml", """[suite]
name = "s"
viewport = [9, 9]
fov_y_deg = 9.5
yardstick = "full"
slack_every = 2
[[terrain]]
id = "a"
samples = [[0, 1.5], [-2, 1e3]]
spacing_m = 2
z_scale = -1
constraints = "generated"
[[terrain]]
id = "b"
file = "../b.tif"
size = 9
fit = "crop"
holes = "fill"
[[terrain]]
id = "c"
points = "c.gpkg"
size = "native"
[[mesh]]
id = "m"
file = "m.ply"
at = [[0, 0, 0], [1, 2, 3]]
scale = 0.5
cut_to_manifold = true
[[mesh]]
id = "n"
generator = "instrument"
[[trajectory]]
id = "p"
kind = "poses"
poses = [{ position = [0, 0, 9], look_at = [1, 1, 0] }]
[[trajectory]]
id = "h"
kind = "hover"
frames = 3
height_m = 1
jitter_px = 0.5
seed = 2
[[trajectory]]
id = "o"
kind = "orbit"
around = "mesh"
frames = 2
distance_radii = 2
[[method]]
id = "full"
thresholds_px = [0.5, 1, 2]
subjects = ["a", "m"]
trajectories = ["p"]
[[method]]
id = "block_bintree:tri_cull"
thresholds_px = [1]
options = { size = 8, flag = true, text = "x" }
[gate]
crack = 0
"vertical_m.max" = "<= 3"
displacement_px.p99 = "<= 1.5 tau"
[gate.full]
hole = ">= 0"
[gate."block_bintree:tri_cull"]
displacement_px = { max = "< 2 tau" }
""")


def case() -> None:
    head = 'schema = "plumbline.case/1"\nlaw = "l"\nmethod = "m"\nthreshold_px = 1\nfov_y_deg = 60\nviewport = [4, 3]\n'
    tail = '[[pose]]\nposition = [0, 0, 9]\nlook_at = [1, 1, 0]\n[expected]\n'
    put("case", "samples.toml", head + 'note = "a \\u0007 \\" b"\n[options]\na = 1\nb = true\nc = "t"\n"d e" = -0.0\n[terrain]\ncolumns = 2\nrows = 2\nspacing_m = 0.1\nsamples_m = [[1e300, -0.0], [1e-320, 0x10]]\n' + tail + 'outcome = "violated"\nwhat = "w"\ncode = 302\nkind = "k"\nat = [1, 2, 3]\ngap_m = 0.25\n')
    put("case", "generator.toml", head + '[terrain]\ngenerator = "fbm"\nseed = 3\nsize = 5\nspacing_m = 2.5\nrelief_m = 7\n' + tail + 'outcome = "held"\n')


def judge() -> None:
    corners = [(0, 0, 0), (4, 0, 1), (4, 4, 2), (0, 4, 3)]
    flat = [x for p in corners for x in p]
    put("judge", "clean", bytes([4, *flat, 0, 1, 2, 0, 2, 3]))
    put("judge", "hole", bytes([4, *flat, 0, 1, 2]))
    put("judge", "overlap_and_fold", bytes([4, *flat, 0, 1, 2, 0, 2, 3, 0, 1, 3, 3, 2, 1]))
    put("judge", "t_junction", bytes([5, *flat, 2, 2, 7, 0, 1, 2, 0, 4, 3, 4, 2, 3]))
    put("judge", "clean_fan", bytes([5, *flat, 2, 2, 7, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]))
    put("judge", "crack", bytes([6, *flat, 0, 0, 1, 4, 4, 3, 0, 1, 2, 4, 5, 3]))
    put("judge", "hard_numbers", bytes([6, *flat, 254, 0, 0, 244, 250, 247, 0, 1, 2, 4, 5, 3, 0, 5, 6, 0, 0, 1]))
    put("judge", "nearly_straight", bytes([5, *flat, 250, 251, 0, 0, 1, 2, 0, 2, 4, 4, 2, 3, 0, 4, 3]))


def tile() -> None:
    def deltas(values: list[int]) -> bytes:
        last, out = 0, b""
        for value in values:
            d = value - last
            out += struct.pack("<H", 2 * d if d >= 0 else -2 * d - 1)
            last = value
        return out

    def lists(code: str, triangles: list[int], edges: list[list[int]]) -> bytes:
        out, highest = struct.pack("<I", len(triangles) // 3), 0
        for index in triangles:
            out += struct.pack("<" + code, highest - index)
            highest += index == highest
        for edge in edges:
            out += struct.pack(f"<I{len(edge)}{code}", len(edge), *edge)
        return out

    header = struct.pack("<3d2f4d3d", 4.4e6, 5.4e5, 4.6e6, 100, 900, 4.4e6, 5.4e5, 4.6e6, 7e4, 0.7, 0.09, 0.72)
    corners = struct.pack("<I", 4) + deltas([0, 32767, 32767, 0]) + deltas([0, 0, 32767, 32767]) + deltas([0, 9, 32767, 7])
    body = header + corners + lists("H", [0, 1, 2, 0, 2, 3], [[0, 3], [0, 1], [1, 2], [3, 2]])
    put("tile", "square.terrain", body)
    put("tile", "square_gzipped.terrain", gzip.compress(body, 9, mtime=0))
    json_text = b'{"geometricerror":5}'
    more = struct.pack("<BI8B", 1, 8, 128, 128, 0, 255, 7, 99, 255, 0)
    more += struct.pack("<BIB", 2, 1, 255) + struct.pack("<BII", 4, 4 + len(json_text), len(json_text)) + json_text
    put("tile", "extensions.terrain", body + more + b"\0\0\0")
    put("tile", "unknown_extension.terrain", body + struct.pack("<BI3B", 9, 3, 1, 2, 3))
    put("tile", "bad_index.terrain", header + corners + lists("H", [0, 1, 2], [[0, 9], [], [], []])[:-16] + struct.pack("<4I", 0, 0, 0, 0))
    put("tile", "empty.terrain", header + struct.pack("<6I", 0, 0, 0, 0, 0, 0))
    put("tile", "many_vertices.terrain", gzip.compress(header + struct.pack("<I", 65537) + deltas([0] * 65537 * 3) + b"\0\0" + lists("I", [0, 1, 2], [[0], [], [], []]), 9, mtime=0))


def layer() -> None:
    ranges = [[{"startX": 0, "startY": 0, "endX": 1, "endY": 0}], [{"startX": 0, "startY": 0, "endX": 3, "endY": 1}, {"startX": 1, "startY": 1, "endX": 2, "endY": 1}]]
    whole = {"tilejson": "2.1.0", "format": "quantized-mesh-1.0", "version": "1.2.0", "scheme": "tms", "tiles": ["{z}/{x}/{y}.terrain?v={version}"], "projection": "EPSG:4326", "bounds": [0, -90, 180, 90.0], "minzoom": 0, "maxzoom": 1, "extensions": ["octvertexnormals"], "available": ranges}
    put("layer", "whole.json", json.dumps(whole))
    put("layer", "mercator.json", json.dumps({"projection": "EPSG:3857", "scheme": "slippyMap", "tiles": ["a"], "parentUrl": "b", "metadataAvailability": 10, "available": [[], [{"startX": 0, "startY": 0, "endX": 1, "endY": 1}]]}))
    put("layer", "least.json", "{}")
    put("layer", "deep.json", json.dumps({"available": [[]] * 25 + [[{"startX": 0, "startY": 0, "endX": 67108863, "endY": 33554431}]]}))


def results() -> None:
    run = {"id": "a.b.full.1", "terrain": "a", "frames": [{"index": 0, "triangles": 2, "vertical_m": {"at": [1, 2.5]}}], "summary": {"frames": 1, "conformity": {"crack": 0, "hole": 2}, "displacement_px": {"p99": 0.25, "max": None}, "self_intersection": 3}}
    put("results", "results.json", json.dumps({
        "schema": "plumbline.results/1", "suite": "s", "yardstick": "full", "viewport": [9, 9], "fov_y_deg": 60, "pass": False, "interrupted": False,
        "selftest": {"pass": True}, "terrains": [{"id": "a", "columns": 3}], "meshes": [], "runs": [run, {**run, "id": "a.b.full.2"}],
        "gates": [{"name": "crack", "run": "a.b.full.1", "limit": "crack == 0", "value": 1, "pass": False}], "vacuous": ["x"]}))
    put("results", "check.json", json.dumps({
        "schema": "plumbline.check/1", "verdict": "faulty", "frame": "own", "camera": {"fov_y_deg": 60},
        "meshes": [{"file": "a/b/one.ply", "triangles": 10, "shape": {"min_quality": 0.5}}, {"file": "a/b/two.ply"}, {"file": "a/b/two.ply"}],
        "conformity": {"crack": 2}, "findings_total": 3,
        "findings": [{"code": 302, "name": "crack", "kind": "gap", "mesh": "a/b/one.ply", "at": [1, 2, None]}, {"code": 302, "mesh": 0, "other_mesh": 1, "at": [1, 2, 4]}],
        "seams": [{"mesh": 0, "other_mesh": 1, "state": "covered by a skirt", "largest_gap_m": -0.5}],
        "vertical_m": {"max": 1.5, "at": [3, 4]}, "declared_m": 2, "declared_holds": True}))


def expected() -> None:
    entry = 'run = "hills.skim.full.1"\nfigure = "crack"\nvalue = "== 63"\nwhy = "steep"\n'
    put("expected", "tables.toml", f"[[expected]]\n{entry}[[expected]]\n{entry.replace('full.1', '*')}")
    put("expected", "inline.toml", 'expected = [\n  { run = "*", figure = "displacement_px.p99", value = "<= 2 tau", why = "w" },\n  { run = "*.spin.*.2.5", figure = "hole", value = 3, why = "w" },\n]\n')
    put("expected", "none.toml", "expected = []\n")


for write in (ply, obj, off, stl, gltf, pose, suite, case, judge, tile, layer, results, expected):
    write()
