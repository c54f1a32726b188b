// Lists every issue of an input or a file by number: the only source of codes, exit codes, hints and the
// checker. A number is never reused. E1xxx input files, E2xxx containers, E3xxx meaning of chunks, E4xxx the
// machine, E5xxx plans and farms, E7xxx Hearth itself; W is a warning with the same numbering.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hearth
{

/// Consequence of an issue for the process: the exit codes of sysexits.h that Hearth uses.
enum class IssueClass : uint8_t
{
    warning,     ///< the work continues
    usage,       ///< 2: the command line is wrong
    malformed,   ///< 65: the input's content is wrong
    missing,     ///< 66: an input does not exist or cannot be read
    internal,    ///< 70: a defect of Hearth
    cannotWrite, ///< 73: an output cannot be created
    io,          ///< 74: reading or writing failed half way
    temporary,   ///< another try may succeed
    config,      ///< a profile or another settings file is wrong
};

// X(name, code, class, summary, hint)
#define HEARTH_ISSUES(X)                                                                                     \
    X(usage, 1000, usage, "the command line is wrong", "see --help")                                         \
    X(input_missing, 1001, missing, "an input file cannot be read", "check the path and its permissions")    \
    X(input_kind_unknown, 1002, malformed, "the kind of file is not known",                                  \
      "use glTF, GLB, OBJ, PLY, STL, OFF, Draco or an image")                                                \
    X(input_too_large, 1003, malformed, "an input asks for more than the limits allow",                      \
      "split the asset, or check that its counts are right")                                                 \
    X(json_syntax, 1100, malformed, "the JSON text is not valid", "export the file again")                   \
    X(gltf_structure, 1101, malformed, "a glTF property has the wrong type or is missing",                   \
      "run the Khronos glTF validator on the file")                                                          \
    X(gltf_value, 1102, malformed, "a glTF property has a value that is not allowed",                        \
      "run the Khronos glTF validator on the file")                                                          \
    X(gltf_reference, 1103, malformed, "a glTF index points outside its array",                              \
      "run the Khronos glTF validator on the file")                                                          \
    X(gltf_version, 1104, malformed, "the glTF version is not supported", "export the file as glTF 2.0")     \
    X(gltf_extension, 1105, malformed, "a required glTF extension is not supported",                         \
      "export the file without it")                                                                          \
    X(glb_structure, 1106, malformed, "the GLB container is damaged", "export the file again")               \
    X(gltf_bounds, 1107, malformed, "data lies outside its buffer or buffer view",                           \
      "the file is damaged or was cut off: export it again")                                                 \
    X(gltf_data, 1108, malformed, "the data of an accessor is not allowed",                                  \
      "run the Khronos glTF validator on the file")                                                          \
    X(gltf_hierarchy, 1109, malformed, "the nodes do not form a tree", "give every node one parent at most") \
    X(uri_outside, 1110, malformed, "a URI leaves the folder of its asset",                                  \
      "put the file beside the asset and use a relative path")                                               \
    X(uri_malformed, 1111, malformed, "a URI cannot be understood", "use a relative path or a data URI")     \
    X(buffer_missing, 1112, missing, "a buffer file cannot be read",                                         \
      "put the file where the asset expects it")                                                             \
    X(buffer_short, 1113, malformed, "a buffer is shorter than it says",                                     \
      "the file is damaged or was cut off: export it again")                                                 \
    X(codec_failed, 1114, malformed, "compressed geometry cannot be decoded",                                \
      "the file is damaged: export it again")                                                                \
    X(index_out_of_range, 1115, malformed, "an index points outside the vertices", "export the file again")  \
    X(number_too_large, 1116, malformed, "a number is larger than Hearth can use",                           \
      "use smaller numbers: a larger unit, or a model nearer to its origin")                                 \
    X(gltf_extension_value, 1117, malformed, "an extension or custom property of a glTF file is not right",  \
      "correct the property, or export the file without it")                                                 \
    X(mesh_syntax, 1200, malformed, "a mesh file is not written as its format asks",                         \
      "export the file again")                                                                               \
    X(mesh_counts, 1201, malformed, "a mesh file ends before its counts are met",                            \
      "the file is damaged or was cut off: export it again")                                                 \
    X(mesh_empty, 1202, malformed, "a mesh file has no geometry", "check the export")                        \
    X(material_missing, 1203, warning, "a material library is missing; its materials are drawn grey",        \
      "put the file where the asset expects it")                                                             \
    X(lod_file, 1204, malformed, "a file cannot be a level of detail",                                       \
      "give a source and files that draw one mesh each")                                                     \
    X(image_malformed, 1300, malformed, "an image cannot be decoded", "save the image again")                \
    X(image_unsupported, 1301, malformed, "an image uses a feature that is not supported",                   \
      "save the image as PNG, JPEG, WebP, HDR or EXR")                                                       \
    X(image_missing, 1302, warning, "an image is missing; a placeholder is drawn",                           \
      "put the file where the asset expects it")                                                             \
    X(image_replaced, 1303, warning, "an image cannot be used; a placeholder is drawn",                      \
      "save the image again as PNG, JPEG or WebP")                                                           \
    X(image_alpha, 1304, warning, "an image's alpha is not opacity, as its file says; it is not kept",       \
      "if it is opacity, save the image as PNG, or as TGA with attributes type 3")                           \
    X(image_layers, 1305, warning, "an image has layers beside the one that is read; they are not kept",     \
      "save the layer that is meant as an image of its own")                                                 \
    X(image_depth, 1306, warning, "an image has more bits than are kept of it",                              \
      "colours need 8 bits; save light as EXR or HDR")                                                       \
    X(image_colors, 1307, warning, "colours of an image are converted without its profile",                  \
      "save the image as RGB, or with its ICC profile")                                                      \
    X(image_reader, 1308, malformed, "the program that reads an image has failed",                           \
      "convert the image to PNG, or to EXR if it has floats")                                                \
    X(texture_target, 1309, warning, "no compressed format keeps a texture's error below its target",        \
      "set textures.strict to keep it plain, or a lower textures.quality")                                   \
    X(texture_rule, 1310, config, "a rule for textures does not suit a texture",                             \
      "name a format of the message, or set families or target in the rule that matches")                    \
    X(texture_budget, 1311, warning, "textures are above their budget in their smallest formats",            \
      "raise textures.budget, or set textures.max_size")                                                     \
    X(dropped, 1400, warning, "a part of the source is not kept", "")                                        \
    X(degraded, 1401, warning, "a part of the source is drawn in a simpler way", "")                         \
    X(repaired, 1402, warning, "a part of the source was repaired", "")                                      \
    X(inconsistent, 1403, warning, "a source contradicts itself; what it holds is used",                     \
      "export the file again")                                                                               \
    X(nothing_drawn, 1404, warning, "a source has no triangle; nothing of it is drawn",                      \
      "export meshes of triangles: points and lines are not drawn")                                          \
    X(lod_coverage, 1405, warning, "screen coverages of levels of detail are not used",                      \
      "none needed: a level is drawn while its error is too small to see; extras keep the numbers")          \
    X(receiver_uvs, 1406, warning, "the UVs of a mesh cannot address baked light; it has no receivers",      \
      "give the mesh a second UV set without overlaps, within 0 to 1")                                       \
    X(probe_enclosed, 1407, malformed, "a probe is inside of a solid", "move the probe into the open")       \
    X(size_outlier, 1410, warning, "a source is much larger or smaller than the others of its cook",         \
      "if its unit is wrong, set import.scale in a rule")                                                    \
    X(wrap_failed, 1420, malformed, "a mesh cannot be wrapped",                                              \
      "set a larger proxy.alpha or proxy.offset, or take the proxy from elsewhere")                          \
    X(profile_syntax, 1500, config, "a file of settings is not valid TOML",                                  \
      "see https://toml.io for how TOML is written")                                                         \
    X(profile_key, 1501, config, "a setting is not known here", "check its spelling: see hearth config")     \
    X(profile_value, 1502, config, "the value of a setting is not allowed", "correct the value")             \
    X(profile_unknown, 1510, config, "there is no profile of that name",                                     \
      "name one that is built in or in hearth.toml, or a TOML file")                                         \
    X(profile_circle, 1511, config, "profiles inherit from each other in a circle",                          \
      "let one of them inherit from none")                                                                   \
    X(no_source, 1512, missing, "a folder or pattern has no source in it",                                   \
      "name a folder with glTF, GLB, OBJ, PLY, STL, OFF or Draco files")                                     \
    X(rule_unmatched, 1513, warning, "a rule matches no source",                                             \
      "a pattern starts at the folder of hearth.toml and matches sources, not their textures")               \
    X(lod_repeated, 1514, warning, "two files are the same level of detail",                                 \
      "rename one, or list the levels in a rule of hearth.toml: import.lods")                                \
    X(texture_unmatched, 1515, warning, "a rule for textures matches no texture",                            \
      "hearth inspect prints the names of textures")                                                         \
    X(camera_path, 1600, malformed, "a camera path is not valid",                                            \
      "write a camera a line: PX,PY,PZ,TX,TY,TZ,FOV")                                                        \
    X(table_rows, 1601, malformed, "rows of numbers are not as they should be",                              \
      "write the column names first, then a row of numbers a line")                                          \
    X(container_truncated, 2000, malformed, "the file is too short", "cook the asset again")                 \
    X(container_magic, 2001, malformed, "the file is not a Hearth container", "name a .hearth file")         \
    X(container_version, 2002, malformed, "the file was written by another major version",                   \
      "cook the asset again with this version")                                                              \
    X(container_endian, 2003, malformed, "the file has the byte order of another machine",                   \
      "cook the asset for a little-endian machine")                                                          \
    X(container_size, 2004, malformed, "the file's size is not the size it was written with",                \
      "the file was cut off or appended to: cook the asset again")                                           \
    X(container_header, 2005, malformed, "the header is damaged", "cook the asset again")                    \
    X(container_feature, 2006, malformed, "the file needs a feature that this version lacks",                \
      "use a newer version of Hearth")                                                                       \
    X(container_table, 2007, malformed, "the chunk table is damaged", "cook the asset again")                \
    X(container_padding, 2008, malformed, "bytes between the chunks are not zero", "cook the asset again")   \
    X(chunk_hash, 2009, malformed, "a chunk's content does not match its hash", "cook the asset again")      \
    X(chunk_codec, 2010, malformed, "a chunk cannot be decompressed", "cook the asset again")                \
    X(chunk_missing, 2011, malformed, "a chunk that is needed is missing", "cook the asset again")           \
    X(chunk_size, 2012, malformed, "a chunk's size does not fit its content", "cook the asset again")        \
    X(page_hash, 2013, malformed, "a geometry page does not match its hash", "cook the asset again")         \
    X(container_kind, 2014, malformed, "the container is of another kind than is needed",                    \
      "name a pack (.hearth) that hearth-link wrote")                                                        \
    X(chunk_version, 2015, malformed, "a chunk was written by a newer version",                              \
      "use a newer version of Hearth, or cook the asset again with this one")                                \
    X(meaning_range, 3000, malformed, "a range points outside its table", "cook the asset again")            \
    X(meaning_reference, 3001, malformed, "an index points outside its table", "cook the asset again")       \
    X(meaning_value, 3002, malformed, "a value is not allowed", "cook the asset again")                      \
    X(meaning_monotone, 3003, malformed, "errors or spheres shrink towards the root",                        \
      "cook the asset again")                                                                                \
    X(meaning_bounds, 3004, malformed, "a bound does not contain what it claims", "cook the asset again")    \
    X(meaning_order, 3005, malformed, "records are not in the order that the format asks",                   \
      "cook the asset again")                                                                                \
    X(meaning_geometry, 3006, malformed, "a cluster's geometry is not valid", "cook the asset again")        \
    X(meaning_text, 3007, malformed, "a text is not valid UTF-8", "cook the asset again")                    \
    X(meaning_padding, 3008, malformed, "bytes that must be zero are not", "cook the asset again")           \
    X(meaning_tree, 3009, malformed, "records do not form a tree", "cook the asset again")                   \
    X(cannot_write, 4000, cannotWrite, "an output cannot be written",                                        \
      "check the folder, its rights and the space left")                                                     \
    X(read_failed, 4001, io, "reading failed", "check the disk")                                             \
    X(device, 4002, internal, "no usable graphics device", "install a Vulkan driver (mesa-vulkan-drivers)")  \
    X(device_failed, 4003, internal, "the graphics device failed",                                           \
      "close other programs, or choose another --device")                                                    \
    X(device_limit, 4004, internal, "the scene does not fit the graphics device",                            \
      "split the scene, or use a device with higher limits")                                                 \
    X(out_of_memory, 4005, internal, "the machine has not enough memory",                                    \
      "close other programs, or split the source")                                                           \
    X(streaming_budget, 4006, usage, "the geometry that must stay in memory exceeds the budget",             \
      "raise the budget to what the message says")                                                           \
    X(no_display, 4007, internal, "there is no display to open a window on",                                 \
      "set DISPLAY or WAYLAND_DISPLAY to a display that runs, or draw into a file with hearth-render")       \
    X(texture_format, 4008, internal, "a texture has a format that the graphics device cannot sample",       \
      "cook with textures.families for the device, or let the loader decode textures")                       \
    X(device_memory, 4009, internal, "the graphics device has not enough memory",                            \
      "lower memory budgets, sizes of targets or shadow maps, or close other programs")                      \
    X(device_lost, 4010, internal, "the graphics device was lost",                                           \
      "destroy all that was made on the device, and make it again on a new one")                             \
    X(cache_failed, 4100, warning, "a cache cannot be used as it should; the cook goes on without it",       \
      "check the folder or the server, its rights and the space left")                                       \
    X(plan_syntax, 5000, malformed, "a plan is not valid", "make it again with hearth plan")                 \
    X(plan_stale, 5001, malformed, "an input is not what was planned", "make the plan again")                \
    X(plan_build, 5002, malformed, "the cookers are not those of the plan",                                  \
      "use the build that made the plan, or make the plan again")                                            \
    X(plan_processor, 5003, malformed, "the processor is not of the plan's class",                           \
      "use machines of the class that made the plan, or make the plan again on one of these")                \
    X(shard_incomplete, 5100, warning, "results of a shard are missing", "")                                 \
    X(shard_unverified, 5101, temporary, "the results of a shard are not there, whatever its launcher says", \
      "run the shard again")                                                                                 \
    X(results_lost, 5102, temporary, "results cannot be kept in a cache",                                    \
      "check the cache's folder, its rights and the space left, then run the shard again")                   \
    X(cooker_killed, 5103, temporary, "a cooker was killed",                                                 \
      "give the shard more memory, then run it again")                                                       \
    X(submit_failed, 5104, io, "the batch system has not taken the jobs",                                    \
      "check its installation, or --print")                                                                  \
    X(child_failed, 7001, internal, "a cooker ended abnormally", "report it, with the input")                \
    X(internal, 7000, internal, "Hearth has a defect", "report it, with the input")

enum class Issue : uint16_t
{
#define HEARTH_ISSUE_ENUM(name, code, kind, summary, hint) name = (code),
    HEARTH_ISSUES(HEARTH_ISSUE_ENUM)
#undef HEARTH_ISSUE_ENUM
};

struct IssueInfo
{
    Issue issue;
    IssueClass kind;
    std::string_view name;
    std::string_view summary;
    std::string_view hint;
};

/// Return all issues, in the order of the list above.
std::span<const IssueInfo> allIssues();
const IssueInfo& issueInfo(Issue issue);

} // namespace hearth
