// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/layering/layers.h"

#include <algorithm>
#include <array>
#include <span>

namespace hearth::test
{

namespace
{

using Folders = std::vector<std::string_view>;

/// A folder and its outgoing arrows. An arrow to a folder includes its sub-folders.
struct Layer
{
    std::string_view folder;
    Folders may_include; ///< besides itself
};

// Row of the cookers that have no row of their own. Cookers do not include each other.
constexpr std::string_view kCooker = "cook/*";

// All layers, from the lowest to the highest. Nothing of the runtime includes cook/ or pipelines/.
const std::vector<Layer>& layers()
{
    static const std::vector<Layer> list = {
        // file formats
        {"formats/base", {}},
        {"formats/gpu_shared", {"formats/base"}},
        {"formats/gpu_shared/receivers", {"formats/gpu_shared"}},
        {"formats/gpu_shared/probes", {"formats/gpu_shared"}},
        {"formats/gpu_shared/shadows", {"formats/gpu_shared"}},
        {"formats/gpu_shared/queries", {"formats/gpu_shared"}},
        {"formats/records", {"formats/base", "formats/gpu_shared"}},
        {"formats/texels", {"formats/base", "formats/records"}},
        {"formats/container", {"formats/base", "formats/records"}},
        {"formats/codecs", {"formats/base", "formats/gpu_shared", "formats/records"}},
        {"formats/pack",
         {"formats/base", "formats/codecs", "formats/container", "formats/gpu_shared", "formats/records",
          "formats/texels"}},
        {"formats/scene",
         {"formats/base", "formats/codecs", "formats/gpu_shared", "formats/pack", "formats/records"}},
        {"formats", {"formats/base", "formats/codecs", "formats/pack", "formats/records"}},

        // shared by cookers
        {"cook/command_line", {"formats/base"}},
        {"cook/json", {}},
        {"cook/tools", {"formats", "cook/json"}},
        {"cook/mesh", {"formats"}},
        {"cook/topology", {"formats", "cook/mesh"}},
        {"cook/pages", {"formats"}},
        {"cook/sampling", {"formats"}},
        {"cook/ray_scene", {"formats"}},
        {"cook/environment", {"formats"}},
        {"cook/animation_bounds", {"formats"}},

        {"cook/animation_compression", {"formats", "cook/tools", "cook/animation_bounds"}},

        // cookers
        {kCooker,
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/mesh", "cook/pages",
          "cook/sampling", "cook/animation_bounds"}},

        {"cook/texels/blocks", {}},
        {"cook/texels/bc", {"formats", "cook/texels/blocks"}},
        {"cook/texels/etc2", {"formats", "cook/texels/blocks"}},
        {"cook/texels/rules", {"formats", "cook/tools", "cook/texels/blocks"}},
        {"cook/texels/encoding",
         {"formats", "cook/texels/blocks", "cook/texels/bc", "cook/texels/etc2", "cook/texels/rules"}},
        {"cook/texels/search", {"formats", "cook/texels/encoding", "cook/texels/rules"}},
        {"cook/texels",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/texels/rules",
          "cook/texels/encoding", "cook/texels/search"}},
        {"cook/probes", {"formats", "cook/environment"}},
        {"cook/receivers/select", {"formats"}},
        {"cook/estimates", {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/texels"}},

        {"cook/clusters/core", {"formats", "cook/mesh", "cook/animation_bounds"}},
        {"cook/clusters/partition", {"formats", "cook/mesh", "cook/clusters/core"}},
        {"cook/clusters/simplify", {"formats", "cook/mesh", "cook/clusters/core"}},
        {"cook/clusters/surface", {"formats", "cook/mesh", "cook/clusters/core", "cook/clusters/simplify"}},
        {"cook/clusters/error",
         {"formats", "cook/mesh", "cook/clusters/core", "cook/clusters/simplify", "cook/clusters/surface"}},
        {"cook/clusters/pages", {"formats", "cook/pages", "cook/clusters/core"}},
        {"cook/clusters/levels",
         {"formats", "cook/mesh", "cook/clusters/core", "cook/clusters/partition", "cook/clusters/simplify",
          "cook/clusters/surface", "cook/clusters/error", "cook/clusters/pages"}},
        {"cook/clusters/program",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/mesh", "cook/clusters/core",
          "cook/clusters/levels"}},

        {"cook/proxy/surface", {"formats", "cook/mesh", "cook/clusters/surface"}},
        {"cook/proxy/clean",
         {"formats", "cook/mesh", "cook/sampling", "cook/ray_scene", "cook/proxy/surface"}},
        {"cook/proxy/convex", {"formats", "cook/mesh", "cook/ray_scene", "cook/proxy/surface"}},
        {"cook/proxy/program",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/mesh", "cook/proxy/surface",
          "cook/proxy/clean", "cook/proxy/convex"}},

        {"cook/wrap",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/mesh", "cook/clusters/core",
          "cook/clusters/simplify", "cook/clusters/surface"}},

        {"cook/bricks/grid", {"formats"}},
        {"cook/bricks/voxels", {"formats", "cook/json", "cook/tools", "cook/bricks/grid"}},
        {"cook/bricks/light",
         {"formats", "cook/bricks/grid", "cook/bricks/voxels", "cook/sampling", "cook/ray_scene"}},
        {"cook/bricks/program", {"formats", "cook/command_line", "cook/bricks/voxels", "cook/bricks/light"}},

        {"cook/receivers/bake", {"formats", "cook/sampling", "cook/ray_scene"}},
        {"cook/receivers/unwrap", {"formats", "cook/mesh", "cook/receivers/bake"}},
        {"cook/receivers/scene",
         {"formats", "cook/bricks/grid", "cook/bricks/voxels", "cook/bricks/light", "cook/receivers/bake"}},
        {"cook/receivers/program",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/bricks/voxels",
          "cook/receivers/bake", "cook/receivers/scene", "cook/receivers/select"}},

        {"cook/reflections/place", {"formats"}},
        {"cook/reflections/capture",
         {"formats", "cook/environment", "cook/sampling", "cook/bricks/voxels", "cook/bricks/light",
          "cook/receivers/bake"}},
        {"cook/reflections/program",
         {"formats", "cook/command_line", "cook/probes", "cook/bricks/voxels", "cook/bricks/light",
          "cook/reflections/place", "cook/reflections/capture"}},

        {"cook/visibility/mesh", {"formats", "cook/mesh"}},
        {"cook/visibility/rays", {"formats", "cook/sampling", "cook/visibility/mesh"}},
        {"cook/visibility/light",
         {"formats", "cook/sampling", "cook/visibility/mesh", "cook/visibility/rays"}},
        {"cook/visibility/fit", {"formats", "cook/mesh", "cook/visibility/mesh", "cook/visibility/rays"}},
        {"cook/visibility/scene", {"formats", "cook/mesh", "cook/visibility/rays", "cook/visibility/fit"}},
        {"cook/visibility/program",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "cook/mesh", "cook/pages",
          "cook/sampling", "cook/visibility/mesh", "cook/visibility/rays", "cook/visibility/light",
          "cook/visibility/fit", "cook/visibility/scene"}},

        // from sources to parts
        {"pipelines/import/part",
         {"formats", "cook/json", "cook/tools", "cook/mesh", "cook/animation_bounds",
          "cook/animation_compression", "cook/environment", "cook/probes", "cook/proxy/surface",
          "cook/receivers/bake", "cook/receivers/unwrap"}},
        {"pipelines/images", {"formats"}},
        {"pipelines/import/images", {"formats", "pipelines/images", "pipelines/import/part"}},
        {"pipelines/import/source", {"formats", "cook/tools", "pipelines/import/images"}},
        {"pipelines/import/gltf/document",
         {"formats", "cook/json", "pipelines/import/part", "pipelines/import/source"}},
        {"pipelines/import/gltf",
         {"formats", "cook/tools", "cook/mesh", "pipelines/import/part", "pipelines/import/images",
          "pipelines/import/source", "pipelines/import/gltf/document"}},
        {"pipelines/import/scans",
         {"formats", "pipelines/import/part", "pipelines/import/images", "pipelines/import/source"}},
        {"pipelines/import",
         {"formats", "cook/command_line", "cook/tools", "cook/animation_compression", "cook/probes",
          "pipelines/import/part", "pipelines/import/images", "pipelines/import/source",
          "pipelines/import/gltf", "pipelines/import/scans"}},

        {"pipelines/environments",
         {"formats", "cook/command_line", "cook/environment", "cook/probes", "pipelines/import/images"}},

        // from parts to a pack, and the build graph
        {"pipelines/verify", {"formats", "cook/json"}},
        {"pipelines/link", {"formats", "cook/command_line", "cook/json", "cook/tools", "pipelines/verify"}},
        {"pipelines/texture_files", {"formats"}},
        {"pipelines/light_pictures", {"formats", "pipelines/texture_files"}},
        {"pipelines/export", {"formats", "pipelines/texture_files"}},
        {"pipelines/schemas", {}},
        {"pipelines/cache", {"formats", "cook/tools"}},
        {"pipelines/settings", {"formats", "cook/json", "cook/tools", "pipelines/cache"}},
        {"pipelines/cookers",
         {"formats", "cook/textures", "cook/clusters/core", "cook/clusters/program", "cook/texels/rules",
          "cook/reflections/place", "pipelines/settings"}},
        {"pipelines/graph",
         {"formats", "cook/json", "cook/tools", "pipelines/cache", "pipelines/settings",
          "pipelines/cookers"}},
        {"pipelines/profiles", {"formats", "cook/tools", "pipelines/settings", "pipelines/cookers"}},
        {"pipelines/farm",
         {"formats", "cook/json", "cook/tools", "pipelines/cache", "pipelines/cookers", "pipelines/graph",
          "pipelines/profiles"}},
        {"pipelines/report",
         {"formats", "cook/json", "cook/tools", "pipelines/cookers", "pipelines/graph",
          "pipelines/light_pictures"}},

        // the hearth command
        {"pipelines/command/shell",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "pipelines/schemas", "pipelines/cache",
          "pipelines/cookers", "pipelines/graph", "pipelines/profiles"}},
        {"pipelines/command/sources",
         {"formats", "cook/tools", "pipelines/cookers", "pipelines/profiles", "pipelines/command/shell"}},
        {"pipelines/command/cook",
         {"formats", "cook/command_line", "cook/json", "cook/tools", "pipelines/cache", "pipelines/cookers",
          "pipelines/graph", "pipelines/profiles", "pipelines/farm", "pipelines/report",
          "pipelines/command/shell", "pipelines/command/sources"}},
        {"pipelines/command/farm",
         {"formats", "cook/json", "cook/tools", "pipelines/cache", "pipelines/graph", "pipelines/farm",
          "pipelines/command/shell", "pipelines/command/cook"}},
        {"pipelines/command/topology",
         {"formats", "cook/json", "cook/mesh", "cook/tools", "cook/topology", "pipelines/command/shell"}},
        {"pipelines/command/extract",
         {"formats", "pipelines/verify", "pipelines/light_pictures", "pipelines/texture_files",
          "pipelines/export", "pipelines/command/shell"}},
        {"pipelines/command/inspect",
         {"formats", "cook/json", "cook/tools", "pipelines/report", "pipelines/export",
          "pipelines/command/shell", "pipelines/command/cook", "pipelines/command/topology",
          "pipelines/command/extract"}},
        {"pipelines/command",
         {"formats", "cook/json", "cook/tools", "pipelines/cache", "pipelines/cookers",
          "pipelines/command/shell", "pipelines/command/cook"}},

        // shipped in a game
        {"runtime/frame", {"formats"}},
        {"runtime/pack", {"formats"}},
        {"runtime/pack/queries", {"formats", "runtime/pack"}},
        {"runtime/pack/receivers", {"formats"}},
        {"runtime/shaders", {}},
        {"runtime/shaders/scene", {"formats/gpu_shared"}},
        {"runtime/shaders/cull", {"formats/gpu_shared", "runtime/shaders/scene"}},
        {"runtime/shaders/draw", {"formats/gpu_shared", "runtime/shaders/scene", "runtime/shaders/cull"}},
        {"runtime/shaders/gi", {"formats/gpu_shared", "runtime/shaders/scene"}},
        {"runtime/shaders/shade", {"formats/gpu_shared", "runtime/shaders/scene", "runtime/shaders/gi"}},
        {"runtime/shaders/light",
         {"formats/gpu_shared", "runtime/shaders/scene", "runtime/shaders/cull", "runtime/shaders/shade"}},
        {"runtime/shaders/stack",
         {"formats/gpu_shared", "runtime/shaders/scene", "runtime/shaders/shade", "runtime/shaders/light"}},
        {"runtime/shaders/prepass",
         {"formats/gpu_shared", "runtime/shaders/scene", "runtime/shaders/shade", "runtime/shaders/light"}},
        {"runtime/shaders/post", {"formats/gpu_shared", "runtime/shaders/shade"}},
        {"runtime/gpu/vulkan", {"formats"}},
        {"runtime/gpu/lights", {"formats", "runtime/frame", "runtime/gpu/vulkan"}},
        {"runtime/gpu/frame", {"formats", "runtime/gpu/vulkan", "runtime/gpu/lights"}},
        {"runtime/gpu/textures", {"formats", "runtime/pack", "runtime/gpu/vulkan"}},
        {"runtime/gpu/receivers", {"formats", "runtime/pack", "runtime/shaders", "runtime/gpu/vulkan"}},
        {"runtime/gpu/materials", {"formats", "runtime/pack", "runtime/shaders"}},
        {"runtime/gpu/scene",
         {"formats", "runtime/frame", "runtime/pack", "runtime/gpu/vulkan", "runtime/gpu/lights",
          "runtime/gpu/receivers", "runtime/gpu/textures", "runtime/gpu/materials"}},
        {"runtime/gpu/post",
         {"formats", "runtime/shaders", "runtime/gpu/vulkan", "runtime/gpu/frame", "runtime/gpu/scene"}},
        {"runtime/gpu/passes",
         {"formats", "runtime/frame", "runtime/shaders", "runtime/gpu/vulkan", "runtime/gpu/frame",
          "runtime/gpu/textures", "runtime/gpu/materials", "runtime/gpu/scene", "runtime/gpu/post"}},
        {"runtime/gpu/light_passes",
         {"formats", "runtime/shaders", "runtime/gpu/scene", "runtime/gpu/passes"}},
        {"runtime/gpu/temporal",
         {"formats", "runtime/shaders", "runtime/gpu/vulkan", "runtime/gpu/scene", "runtime/gpu/passes"}},
        {"runtime/gpu/statistics",
         {"formats", "runtime/shaders", "runtime/gpu/vulkan", "runtime/gpu/scene", "runtime/gpu/passes"}},
        {"runtime/gpu",
         {"runtime/gpu/vulkan", "runtime/gpu/frame", "runtime/gpu/receivers", "runtime/gpu/materials",
          "runtime/gpu/scene", "runtime/gpu/post", "runtime/gpu/passes", "runtime/gpu/light_passes"}},
        {"runtime/c", {"formats", "runtime/frame", "runtime/pack", "runtime/gpu"}},
        {"runtime/viewer", {"formats", "runtime/frame", "runtime/pack", "runtime/gpu"}},
        {"runtime/viewer/compare", {"formats", "runtime/viewer"}},
        {"runtime/viewer/report", {"formats", "runtime/gpu", "runtime/viewer"}},
        {"runtime/viewer/render", {"formats", "runtime/pack", "runtime/gpu", "runtime/viewer"}},
        {"runtime/viewer/window",
         {"formats", "runtime/frame", "runtime/pack", "runtime/gpu", "runtime/viewer"}},

        {"runtime/sample_game", {}}, // on installed headers alone

        {"sample_assets/shapes", {"formats", "cook/json"}},
        {"sample_assets/market", {"formats", "sample_assets/shapes"}},
        {"sample_assets/people", {"sample_assets/shapes", "sample_assets/market"}},
        {"sample_assets",
         {"formats", "cook/command_line", "sample_assets/shapes", "sample_assets/market",
          "sample_assets/people"}},
    };
    return list;
}

struct Library
{
    std::string_view header; ///< whole name, or a prefix that ends in '/'
    Folders seen_in;         ///< besides tests/
    bool in_headers = false; ///< else in .cpp files only: the adapter hides its types
};

const std::vector<Library>& libraries()
{
    static const std::vector<Library> list = {
        {"xxhash.h", {"formats/"}},
        {"openssl/", {"cook/tools/"}},
        {"curl/", {"pipelines/cache/"}}, // loaded, not linked
        {"zstd.h",
         {"formats/", "cook/clusters/", "cook/pages/", // pages are compressed in parallel
          "pipelines/texture_files/"}},
        {"vulkan/", {"runtime/gpu/", "runtime/c/", "runtime/viewer/"}, true},
        {"SDL.h", {"runtime/viewer/window/", "runtime/sample_game/"}},
        {"SDL_vulkan.h", {"runtime/viewer/window/", "runtime/sample_game/"}},
        {"imgui.h", {"runtime/viewer/window/", "runtime/sample_game/"}},
        {"backends/", {"runtime/viewer/window/", "runtime/sample_game/"}}, // Dear ImGui's, for SDL and Vulkan
        {"stddef.h", {"runtime/c/"}, true},                                // hearth.h is C
        {"stdint.h", {"runtime/c/"}, true},
        {"png.h",
         {"pipelines/import/images/", "cook/tools/", "runtime/viewer/compare/", "sample_assets/shapes/",
          "runtime/sample_game/"}},
        {"zlib.h", {"pipelines/import/images/", "pipelines/texture_files/"}},
        {"jpeglib.h", {"pipelines/import/"}},
        {"jerror.h", {"pipelines/import/"}},
        {"webp/", {"pipelines/import/"}},
        {"OpenEXR/", {"pipelines/import/", "runtime/viewer/"}},
        {"OpenImageIO/", {"pipelines/images/"}},
        {"lcms2.h", {"pipelines/images/"}},
        {"stb/", {"cook/receivers/bake/", "runtime/viewer/"}}, // packs rectangles; writes PNG
        {"draco/", {"pipelines/import/"}},
        {"astcenc.h", {"cook/specular/", "cook/texels/"}},
        {"meshoptimizer.h", {"pipelines/import/gltf/document/"}},
        {"nlohmann/", {"cook/json/", "pipelines/export/"}},
        {"fmt/", {"cook/", "pipelines/", "sample_assets/"}},
        {"toml++/", {"cook/tools/"}},
        {"tbb/", {"cook/", "pipelines/", "sample_assets/"}, true},
        {"embree3/", {"cook/"}},
        {"xmmintrin.h", {"cook/visibility/"}}, // floating-point mode for Embree
        {"Eigen/", {"cook/"}, true},
        {"ceres/", {"cook/"}},
        {"formats/", {}}, // in angle brackets, as users include the installed headers; so is the next
        {"hearth.hpp", {"runtime/sample_game/"}, true},
        {"hearth_test_functions_material_shaders.h", {}, true}, // made by the build, like the next one
        {"materials_material_shaders.h", {}, true},
        {"gtest/", {}, true},
        {"gmock/", {}, true},
        {"benchmark/", {}, true},
        {"CGAL/", {"cook/wrap/"}}, // and checks distances, in tests
        {"EGL/", {}},              // with the next two: decodes ETC2 as an oracle, in tests
        {"GLES2/", {}},
        {"GLES3/", {}},
        {"OpenMesh/", {"cook/proxy/clean/"}},         // walks holes; and counts boundary loops, in tests
        {"spirv_cross/", {}},                         // reflects shaders, in tests
        {"spirv-tools/", {}},                         // validates shaders, in tests
        {"tiny_gltf.h", {"pipelines/export/"}, true}, // writes glTF; reads it as an oracle, in tests
    };
    return list;
}

/// A library that is slow to compile (seconds per inclusion): only the files listed may include it.
struct SlowLibrary
{
    std::string_view header; ///< whole name, or a prefix that ends in '/'
    Folders included_by;     ///< files, in tests/ too
};

const std::vector<SlowLibrary>& slowLibraries()
{
    static const std::vector<SlowLibrary> list = {
        {"CLI/", {"cook/command_line/command_line.cpp"}},
        {"nlohmann/",
         {"cook/json/json.cpp", "pipelines/export/tinygltf_writer.cpp", "tests/cook/json_test.cpp"}},
        {"toml++/", {"cook/tools/toml.cpp"}},
        {"CGAL/", {"cook/wrap/cgal_wrap.cpp", "tests/support/surfaces/cgal_distance.cpp"}},
        {"OpenMesh/", {"cook/proxy/clean/holes.cpp", "tests/support/surfaces/boundary.cpp"}},
    };
    return list;
}

// POSIX and Linux headers, for features that the standard library lacks
constexpr std::array<std::string_view, 16> kPosixHeaders{
    "sys/",     "linux/",   "elf.h",   "malloc.h",  "unistd.h", "fcntl.h",  "poll.h", "spawn.h",
    "dirent.h", "signal.h", "dlfcn.h", "pthread.h", "arpa/",    "netinet/", "pwd.h",  "regex.h"};

bool isIn(std::string_view path, const Folders& folders)
{
    return std::any_of(folders.begin(), folders.end(),
                       [&](std::string_view f) { return path.starts_with(f); });
}

/// True if a folder is `other` or lies below it.
bool isBelow(std::string_view folder, std::string_view other)
{
    return folder == other || (folder.starts_with(other) && folder.substr(other.size()).starts_with('/'));
}

/// Return the row of a folder; of a folder of cook/ without one, the row of cookers.
const Layer* findLayer(std::string_view folder)
{
    const auto find = [](std::string_view row) -> const Layer*
    {
        const auto found = std::find_if(layers().begin(), layers().end(),
                                        [&](const Layer& layer) { return layer.folder == row; });
        return found == layers().end() ? nullptr : &*found;
    };
    if (const Layer* own = find(folder))
        return own;
    const bool is_in_cook = folder.starts_with("cook/") && folder.find('/', 5) == std::string_view::npos;
    return is_in_cook ? find(kCooker) : nullptr;
}

bool names(std::string_view pattern, std::string_view header)
{
    return pattern.ends_with('/') ? header.starts_with(pattern) : header == pattern;
}

} // namespace

std::string_view getFolder(std::string_view path)
{
    return path.substr(0, path.rfind('/'));
}

std::vector<Arrow> allArrows()
{
    std::vector<Arrow> arrows;
    for (const Layer& layer : layers())
        if (layer.folder != kCooker)
            for (const std::string_view to : layer.may_include)
                arrows.push_back({layer.folder, to});
    return arrows;
}

std::optional<Arrow> findArrow(std::string_view from, std::string_view to)
{
    const Layer* layer = findLayer(from);
    if (layer == nullptr)
        return std::nullopt;
    for (const std::string_view allowed : layer->may_include)
        if (isBelow(to, allowed))
            return Arrow{layer->folder, allowed};
    return std::nullopt;
}

std::optional<std::string> wrongArrow(std::string_view file, std::string_view header)
{
    const std::string_view from = getFolder(file), to = getFolder(header);
    if (from == to || isBelow(from, "tests") || findArrow(from, to))
        return std::nullopt;
    if (findLayer(from) == nullptr)
        return std::string(from) + " is not in the table of folders";
    return std::string(file) + " may not include " + std::string(header);
}

std::optional<std::string> wrongLink(std::string_view from, std::string_view to)
{
    if (isBelow(from, "tests") || isBelow(from, to) || isBelow(to, from))
        return std::nullopt;
    const auto allows = [&](const Layer& layer)
    {
        return std::any_of(layer.may_include.begin(), layer.may_include.end(),
                           [&](std::string_view f) { return isBelow(f, to); });
    };
    if (const Layer* own = findLayer(from); own != nullptr && allows(*own))
        return std::nullopt;
    // A library consists of its folder and the folders below.
    for (const Layer& layer : layers())
        if (isBelow(layer.folder, from) && allows(layer))
            return std::nullopt;
    return std::string(from) + " may not link " + std::string(to);
}

std::vector<std::string_view> allLibraries()
{
    std::vector<std::string_view> headers;
    for (const Library& library : libraries())
        headers.push_back(library.header);
    return headers;
}

std::optional<std::string> wrongLibrary(std::string_view file, std::string_view header)
{
    const bool standard = header.find_first_of("/.") == std::string_view::npos;
    const bool posix = std::any_of(kPosixHeaders.begin(), kPosixHeaders.end(),
                                   [&](std::string_view h) { return names(h, header); });
    if (standard || posix)
        return std::nullopt;
    const auto slow = std::find_if(slowLibraries().begin(), slowLibraries().end(),
                                   [&](const SlowLibrary& l) { return names(l.header, header); });
    if (slow != slowLibraries().end())
        return isIn(file, slow->included_by)
                   ? std::nullopt
                   : std::optional(std::string(header) + " takes seconds to compile: " + std::string(file) +
                                   " may not include it, but use " + std::string(slow->included_by.front()));
    const auto library = std::find_if(libraries().begin(), libraries().end(),
                                      [&](const Library& l) { return names(l.header, header); });
    if (library == libraries().end())
        return std::string(header) + ", included by " + std::string(file) +
               ", is not in the table of libraries";
    if (file.starts_with("tests/"))
        return std::nullopt;
    if (!isIn(file, library->seen_in))
        return std::string(file) + " may not include " + std::string(header);
    if (!library->in_headers && !file.ends_with(".cpp"))
        return std::string(header) + " leaves its adapter: included by " + std::string(file);
    return std::nullopt;
}

std::vector<Include> findIncludes(std::string_view text)
{
    std::vector<Include> includes;
    const auto skipSpace = [](std::string_view line)
    { return line.substr(std::min(line.find_first_not_of(" \t"), line.size())); };
    for (size_t number = 1; !text.empty(); ++number)
    {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = skipSpace(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.starts_with('#'))
            continue;
        line = skipSpace(line.substr(1));
        if (!line.starts_with("include"))
            continue;
        line = skipSpace(line.substr(7));
        if (!line.starts_with('"') && !line.starts_with('<'))
            continue;
        const bool angled = line.front() == '<';
        const size_t close = line.find(angled ? '>' : '"', 1);
        if (close != std::string_view::npos)
            includes.push_back({number, angled, std::string(line.substr(1, close - 1))});
    }
    return includes;
}

} // namespace hearth::test
