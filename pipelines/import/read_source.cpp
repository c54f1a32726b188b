// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/read_source.h"

#include "pipelines/import/asset_folder.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

std::string lowerCaseExtension(const std::string& path)
{
    const size_t name = path.rfind('/') + 1; // npos + 1 is 0
    const size_t dot = path.find_last_of('.');
    std::string extension = dot == std::string::npos || dot < name ? "" : path.substr(dot);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

bool looksLikeGltf(const std::string& path, std::span<const std::byte> bytes)
{
    const std::string extension = lowerCaseExtension(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return extension == ".gltf" || extension == ".glb" || text.starts_with("glTF");
}

} // namespace

Status readSource(const std::string& path, const ImportOptions& options, PartBuilder& part)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                            readFile(path, options.limits.max_file_bytes));
    if (options.reads != nullptr)
        options.reads->add(path, bytes);
    part.addSource(path.substr(path.rfind('/') + 1), bytes);
    if (looksLikeGltf(path, bytes))
        return importGltf(path, bytes, options, part);
    if (looksLikeImage(path, bytes))
        return importImage(path, bytes, options, part);
    return importScan(path, bytes, options, part);
}

} // namespace hearth::import
