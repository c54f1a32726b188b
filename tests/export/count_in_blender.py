# Opens GLB files in Blender and compares its counts with those of the files: meshes, triangles, lights, cameras,
# bones, clips, and proxies, by their names below those of their meshes, with their triangles. Run by
# `blender -b --factory-startup -P count_in_blender.py -- FILE...`; ends with 1 where a file does not open or a count
# differs.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import json
import re
import struct
import sys

import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer asks numpy for a name that 1.24 lacks

COMPONENTS = {5121: "u1", 5123: "<u2", 5125: "<u4"}
CLIP_PATHS = {"translation", "rotation", "scale", "weights"}


def read_file(path):
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def count_triangles(document, binary, mesh):
    """Triangles of a mesh; of those with the same vertices Blender keeps one."""
    count = 0
    for primitive in document["meshes"][mesh]["primitives"]:
        accessor = document["accessors"][primitive["indices"]]
        view = document["bufferViews"][accessor["bufferView"]]
        indices = numpy.frombuffer(
            binary, COMPONENTS[accessor["componentType"]], accessor["count"], view.get("byteOffset", 0)
        )
        corners = numpy.sort(indices.reshape(-1, 3), axis=1)
        count += len(numpy.unique(corners, axis=0))
    return count


def is_proxy(name):
    return name.endswith("_PROXY") or name.startswith("UCX_")


def find_proxies(document, binary):
    """By the name of a proxy: the name of the node above it, and its triangles. Blender changes equal and long names."""
    nodes = document.get("nodes", [])
    names = [node.get("name", "") for node in nodes]
    is_kept = [0 < len(name.encode()) < 64 and names.count(name) == 1 for name in names]
    return {
        names[child]: (names[i], count_triangles(document, binary, nodes[child]["mesh"]))
        for i, node in enumerate(nodes)
        for child in node.get("children", [])
        if "mesh" in nodes[child] and is_proxy(names[child]) and is_kept[child] and is_kept[i]
    }


def count_in_file(path):
    document, binary = read_file(path)
    levels = {i for n in document.get("nodes", []) for i in n.get("extensions", {}).get("MSFT_lod", {}).get("ids", [])}
    nodes = [n for i, n in enumerate(document.get("nodes", [])) if i not in levels]
    drawn = [n["mesh"] for n in nodes if "mesh" in n]
    triangles = {mesh: count_triangles(document, binary, mesh) for mesh in set(drawn)}
    return {
        "meshes": len(drawn),
        "triangles": sum(triangles[mesh] for mesh in drawn),
        "lights": sum("KHR_lights_punctual" in n.get("extensions", {}) for n in nodes),
        "cameras": sum("camera" in n for n in nodes),
        "bones": len({joint for skin in document.get("skins", []) for joint in skin["joints"]}),
        "clips": sum(
            any(c["target"]["path"] in CLIP_PATHS for c in clip["channels"]) for clip in document.get("animations", [])
        ),
        "proxies": len(find_proxies(document, binary)),
    }


def count_polygons(mesh):
    return sum(len(polygon.vertices) - 2 for polygon in mesh.data.polygons)


def is_called(name, expected):
    """Blender adds a number where an object of its own, such as that of a skin, has the name already."""
    return re.fullmatch(re.escape(expected) + r"(\.\d{3})?", name) is not None


def is_same_proxy(item, proxies):
    if item.parent is None or item.name not in proxies:
        return False
    parent, triangles = proxies[item.name]
    return is_called(item.parent.name, parent) and count_polygons(item) == triangles


def count_in_blender(path, proxies):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    # the importer's own shapes of bones lie in a collection of their own
    own = {o.name for c in bpy.data.collections if c.name.startswith("glTF_not_exported") for o in c.objects}
    objects = [o for o in bpy.data.objects if o.name not in own]
    meshes = [o for o in objects if o.type == "MESH"]
    animated = objects + [o.data.shape_keys for o in meshes if o.data.shape_keys]
    tracks = {t.name for o in animated if o.animation_data for t in o.animation_data.nla_tracks}
    return {
        "meshes": len(meshes),
        "triangles": sum(count_polygons(o) for o in meshes),
        "lights": sum(o.type == "LIGHT" for o in objects),
        "cameras": sum(o.type == "CAMERA" for o in objects),
        "bones": sum(len(a.bones) for a in bpy.data.armatures),
        "clips": len(tracks),
        "proxies": sum(is_same_proxy(o, proxies) for o in meshes),
    }


def main():
    files = sys.argv[sys.argv.index("--") + 1 :]
    same = 0
    for path in files:
        expected = count_in_file(path)
        try:
            found = count_in_blender(path, find_proxies(*read_file(path)))
        except RuntimeError as error:
            print(f"{path}: does not open: {error}")
            continue
        differences = [f"{k} {expected[k]} in the file, {found[k]} in Blender" for k in found if found[k] != expected[k]]
        print(f"{path}: {', '.join(differences) or 'same'}")
        same += not differences
    print(f"{same} of {len(files)} files open in Blender with the same counts")
    sys.exit(0 if same == len(files) else 1)


main()
