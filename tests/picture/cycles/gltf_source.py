# Rewrites a glTF file so that Blender's importer shows what Hearth is asked to draw: the rest pose, instances
# as nodes, images that it would not find, and lights that can be told apart.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import json
import os
import struct
import urllib.parse

import numpy

GLB_MAGIC = 0x46546C67
JSON_CHUNK = 0x4E4F534A
COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
# of KHR_mesh_quantization and core: type, divisor of normalized values
COMPONENT_TYPES = {
    5120: ("<i1", 127),
    5121: ("<u1", 255),
    5122: ("<i2", 32767),
    5123: ("<u2", 65535),
    5126: ("<f4", 1),
}


def read_document(path):
    """Return the JSON of a .gltf or .glb file, and the bytes of the latter's own buffer."""
    with open(path, "rb") as file:
        content = file.read()
    if path.endswith(".gltf"):
        return json.loads(content), b""
    magic, _, _ = struct.unpack_from("<III", content)
    if magic != GLB_MAGIC:
        raise ValueError(path + " is no GLB file")
    length, kind = struct.unpack_from("<II", content, 12)
    if kind != JSON_CHUNK:
        raise ValueError(path + " does not begin with JSON")
    document = json.loads(content[20 : 20 + length])
    rest = content[20 + length :]
    return document, rest[8 : 8 + struct.unpack_from("<I", rest)[0]] if rest else b""


def write_document(path, document, binary):
    """Write a .glb file."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    if binary:
        chunks += struct.pack("<I", len(binary)) + b"BIN\0" + binary
    with open(path, "wb") as file:
        file.write(struct.pack("<III", GLB_MAGIC, 2, 12 + len(chunks)) + chunks)


def make_paths_absolute(document, folder):
    for item in document.get("buffers", []) + document.get("images", []):
        uri = item.get("uri", "data:")
        if not uri.startswith("data:"):
            item["uri"] = urllib.parse.quote(os.path.join(folder, urllib.parse.unquote(uri)))


def read_accessor(document, folder, binary, index):
    """Return the values of a plain accessor as floats, a row an element."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    buffer = document["buffers"][view["buffer"]]
    if "uri" in buffer:
        with open(os.path.join(folder, urllib.parse.unquote(buffer["uri"])), "rb") as file:
            binary = file.read()
    dtype, divisor = COMPONENT_TYPES[accessor["componentType"]]
    count = COMPONENTS[accessor["type"]]
    size = numpy.dtype(dtype).itemsize * count
    stride = view.get("byteStride", size)
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    rows = [
        numpy.frombuffer(binary, dtype, count, start + i * stride).astype(float)
        for i in range(accessor["count"])
    ]
    return numpy.array(rows) / (divisor if accessor.get("normalized") else 1)


def expand_instances(document, folder, binary):
    """Replace EXT_mesh_gpu_instancing by child nodes."""
    for node in list(document.get("nodes", [])):
        instancing = node.get("extensions", {}).pop("EXT_mesh_gpu_instancing", None)
        if instancing is None:
            continue
        columns = {
            name.lower(): read_accessor(document, folder, binary, accessor)
            for name, accessor in instancing["attributes"].items()
            if name in ("TRANSLATION", "ROTATION", "SCALE")
        }
        mesh = node.pop("mesh")
        children = node.setdefault("children", [])
        for i in range(len(next(iter(columns.values())))):
            children.append(len(document["nodes"]))
            placement = {name: list(rows[i]) for name, rows in columns.items()}
            document["nodes"].append({"mesh": mesh, **placement})


def prepare(path, output):
    """Write the rewritten file and return its lights, as KHR_lights_punctual has them.

    Light i is called LIGHT_i in the file.
    """
    document, binary = read_document(path)
    folder = os.path.dirname(os.path.abspath(path))
    expand_instances(document, folder, binary)
    make_paths_absolute(document, folder)
    document.pop("animations", None)
    for texture in document.get("textures", []):
        webp = texture.get("extensions", {}).pop("EXT_texture_webp", None)
        if webp is not None:
            texture["source"] = webp["source"]
    for material in document.get("materials", []):  # Hearth reads metallic-roughness alone
        material.get("extensions", {}).pop("KHR_materials_pbrSpecularGlossiness", None)
    lights = document.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for index, light in enumerate(lights):
        light["name"] = "LIGHT_%d" % index
    handled = ("EXT_mesh_gpu_instancing", "EXT_texture_webp", "KHR_materials_pbrSpecularGlossiness")
    for key in ("extensionsUsed", "extensionsRequired"):
        left = [name for name in document.pop(key, []) if name not in handled]
        if left:
            document[key] = left
    write_document(output, document, binary)
    return lights
