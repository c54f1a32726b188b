// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/cooker_version.h"

#include "cook/tools/sha256.h"
#include "pipelines/cache/fields.h"
#include "pipelines/graph/shared_libraries.h"

#include <algorithm>

namespace hearth::graph
{

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
