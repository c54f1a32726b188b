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

struct Layer
{
    std::string_view folder;
    Folders may_include; ///< besides itself
};

// The first line that a path starts with holds. A folder of cook/ that is not named sees formats, cook/command_line, cook/json,
// cook/tools, cook/mesh, cook/motion, cook/pages and cook/sampling only.
const std::vector<Layer>& layers()
{
    static const std::vector<Layer> list = {
        {"formats/", {}},
        {"cook/command_line/", {}},
        {"cook/json/", {}},
        {"cook/tools/", {"formats/", "cook/json/"}},
        {"cook/mesh/", {"formats/"}},
        {"cook/motion/", {"formats/"}},
        {"cook/pages/", {"formats/"}},
        {"cook/sampling/", {"formats/"}},
        {"cook/",
         {"formats/", "cook/command_line/", "cook/json/", "cook/tools/", "cook/mesh/", "cook/motion/",
          "cook/pages/", "cook/sampling/"}},
        // extract draws the cut that the runtime would draw
        {"pipelines/command/", {"formats/", "cook/", "pipelines/", "runtime/pack/"}},
        {"pipelines/", {"formats/", "cook/", "pipelines/"}},
        {"runtime/pack/", {"formats/"}},
        {"runtime/shaders/", {"formats/shared/"}},
        {"runtime/gpu/", {"formats/", "runtime/pack/", "runtime/shaders/"}},
        {"runtime/c/", {"formats/", "runtime/pack/", "runtime/gpu/"}},
        {"runtime/viewer/", {"formats/", "runtime/pack/", "runtime/gpu/"}},
        {"sample_assets/", {"formats/", "cook/command_line/", "cook/json/"}},
        {"tests/", {"formats/", "cook/", "pipelines/", "runtime/", "sample_assets/", "tests/"}},
    };
    return list;
}

struct Library
{
    std::string_view header; ///< whole, or a start that ends in '/'
    Folders seen_in;         ///< besides tests/
    bool in_headers = false; ///< else in .cpp files only: its types stay inside an adapter
};

const std::vector<Library>& libraries()
{
    static const std::vector<Library> list = {
        {"xxhash.h", {"formats/"}},
        {"openssl/", {"cook/tools/"}},
        {"curl/", {"pipelines/cache/"}},                           // loaded, not linked
        {"zstd.h", {"formats/", "cook/clusters/", "cook/pages/"}}, // pages are compressed in parallel
        {"vulkan/", {"runtime/gpu/", "runtime/c/", "runtime/viewer/"}, true},
        {"SDL.h", {"runtime/viewer/window/"}},
        {"SDL_vulkan.h", {"runtime/viewer/window/"}},
        {"imgui.h", {"runtime/viewer/window/"}},
        {"backends/", {"runtime/viewer/window/"}}, // Dear ImGui's, for SDL and Vulkan
        {"stddef.h", {"runtime/c/"}, true},        // hearth.h is C
        {"stdint.h", {"runtime/c/"}, true},
        {"png.h",
         {"pipelines/import/", "cook/textures/", "cook/visibility/", "runtime/viewer/", "sample_assets/"}},
        {"jpeglib.h", {"pipelines/import/"}},
        {"jerror.h", {"pipelines/import/"}},
        {"webp/", {"pipelines/import/"}},
        {"OpenEXR/", {"pipelines/import/"}},
        {"stb/", {"pipelines/import/", "cook/textures/", "runtime/viewer/"}}, // the viewer writes PNG
        {"stb_image.h", {"pipelines/import/"}},
        {"stb_image_resize.h", {"cook/textures/"}},
        {"OpenImageIO/", {"pipelines/import/", "cook/textures/"}},
        {"draco/", {"pipelines/import/"}},
        {"astcenc.h", {"cook/specular/"}},
        {"meshoptimizer.h", {"pipelines/import/", "cook/clusters/"}},
        {"tiny_gltf.h", {"pipelines/import/"}},
        {"OpenMesh/", {"pipelines/import/", "cook/"}},
        {"nlohmann/", {"cook/json/"}},
        {"fmt/", {"cook/", "pipelines/", "sample_assets/"}},
        {"spdlog/", {"cook/", "pipelines/"}},
        {"toml++/", {"cook/tools/"}},
        {"tbb/", {"cook/", "pipelines/", "sample_assets/"}, true},
        {"embree3/", {"cook/"}},
        {"xmmintrin.h", {"cook/visibility/"}}, // how Embree wants the processor set
        {"CGAL/", {"cook/"}},
        {"Eigen/", {"cook/"}, true},
        {"ceres/", {"cook/"}},
        {"formats/", {}}, // in brackets as users include what is installed; so are the next two
        {"hearth.h", {}},
        {"hearth.hpp", {}},
        {"gtest/", {}, true},
        {"gmock/", {}, true},
        {"benchmark/", {}, true},
    };
    return list;
}

/// A library that takes seconds to compile wherever it is included: all others go through the files that may.
struct SlowLibrary
{
    std::string_view header; ///< whole, or a start that ends in '/'
    Folders included_by;     ///< files, in tests/ too
};

const std::vector<SlowLibrary>& slowLibraries()
{
    static const std::vector<SlowLibrary> list = {
        {"CLI/", {"cook/command_line/command_line.cpp"}},
        {"nlohmann/", {"cook/json/json.cpp", "tests/cook/json_test.cpp"}},
        {"toml++/", {"cook/tools/toml.cpp"}},
    };
    return list;
}

// POSIX and Linux: what the standard library does not give
constexpr std::array<std::string_view, 16> kPosixHeaders{
    "sys/",     "linux/",   "elf.h",   "malloc.h",  "unistd.h", "fcntl.h",  "poll.h", "spawn.h",
    "dirent.h", "signal.h", "dlfcn.h", "pthread.h", "arpa/",    "netinet/", "pwd.h",  "regex.h"};

bool isIn(std::string_view path, const Folders& folders)
{
    return std::any_of(folders.begin(), folders.end(),
                       [&](std::string_view f) { return path.starts_with(f); });
}

const Layer* layerOf(std::string_view path)
{
    const auto found = std::find_if(layers().begin(), layers().end(),
                                    [&](const Layer& layer) { return path.starts_with(layer.folder); });
    return found == layers().end() ? nullptr : &*found;
}

/// "cook/clusters/" of "cook/clusters/split.cpp": cookers do not include each other.
std::string_view ownFolder(const Layer& layer, std::string_view file)
{
    if (layer.folder != "cook/")
        return layer.folder;
    const size_t slash = file.find('/', layer.folder.size());
    return slash == std::string_view::npos ? layer.folder : file.substr(0, slash + 1);
}

bool names(std::string_view pattern, std::string_view header)
{
    return pattern.ends_with('/') ? header.starts_with(pattern) : header == pattern;
}

} // namespace

std::optional<std::string> wrongArrow(std::string_view file, std::string_view header)
{
    const Layer* layer = layerOf(file);
    if (layer == nullptr)
        return std::string(file) + " lies in no folder of DESIGN";
    if (header.starts_with(ownFolder(*layer, file)) || isIn(header, layer->may_include))
        return std::nullopt;
    return std::string(file) + " may not include " + std::string(header);
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

std::vector<Include> includesOf(std::string_view text)
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
