// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/cooker_version.h"

#include "cook/tools/sha256.h"
#include "pipelines/cache/fields.h"
#include "pipelines/graph/shared_libraries.h"

#include <algorithm>
#include <array>

namespace hearth::graph
{

namespace
{

// hearth-import starts hearth-images, whose texels depend on these of its 262 libraries
constexpr std::string_view kStarts = "/hearth-import", kStarted = "/hearth-images";
constexpr std::array<std::string_view, 5> kDecoders{"/libOpenImageIO.so", "/libtiff.so", "/libopenjp2.so",
                                                    "/libOpenEXR", "/liblcms2.so"};

/// Add the program that a cooker starts, where there is one, and its decoders.
void addStarted(const std::string& executable, FileHashes& hashes, cache::Fields& fields)
{
    if (!executable.ends_with(kStarts))
        return;
    const std::string program =
        executable.substr(0, executable.size() - kStarts.size()) + std::string(kStarted);
    fields.emplace_back("starts", hashes.hashFile(program).value_or(""));
    for (const std::string& library : findLibraries(program))
        if (std::any_of(kDecoders.begin(), kDecoders.end(),
                        [&](std::string_view name) { return library.find(name) != std::string::npos; }))
            fields.emplace_back("started_library", hashes.hashFile(library).value_or(""));
}

} // namespace

std::string cookerVersion(const std::string& executable, FileHashes& hashes)
{
    const std::optional<std::string> program = hashes.hashFile(executable);
    if (!program)
        return "";
    // by content: folder names do not matter
    std::vector<std::string> libraries;
    for (const std::string& library : findLibraries(executable))
        // it only computes hashes, and is updated more often than all others together
        if (library.find("/libcrypto.so") == std::string::npos)
            libraries.push_back(hashes.hashFile(library).value_or(""));
    std::sort(libraries.begin(), libraries.end());
    cache::Fields fields{{"program", *program}};
    for (const std::string& library : libraries)
        fields.emplace_back("library", library);
    addStarted(executable, hashes, fields);
    return tools::computeSha256(cache::formatFields(fields));
}

const char* processorClass()
{
    return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512bw")
               ? "avx512"
           : __builtin_cpu_supports("avx2")   ? "avx2"
           : __builtin_cpu_supports("avx")    ? "avx"
           : __builtin_cpu_supports("sse4.2") ? "sse4.2"
                                              : "sse2";
}

} // namespace hearth::graph
