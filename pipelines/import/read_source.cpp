// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/read_source.h"

#include "pipelines/import/gltf/import_gltf.h"
#include "pipelines/import/image_card.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/part/part_proxies.h"
#include "pipelines/import/scans/import_scan.h"
#include "pipelines/import/source/file_bytes.h"

#include "pipelines/import/source/asset_folder.h"

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
    HEARTH_ASSIGN_OR_RETURN(const FileBytes file, FileBytes::read(path, options.limits.max_file_bytes));
    if (options.reads != nullptr)
        recordRead(*options.reads, path, file);
    part.addSource(path.substr(path.rfind('/') + 1), file.bytes().size(), file.hash());
    const std::span<const std::byte> bytes = file.bytes();
    if (looksLikeGltf(path, bytes))
        HEARTH_TRY(importGltf(path, file, options, part));
    else if (looksLikeImage(path, bytes))
    {
        if (options.file_proxies != nullptr)
            return Error{Issue::usage, "--proxy " + options.file_proxies->front().word, "",
                         path + " is an image: it has no mesh that a proxy could stand for"};
        HEARTH_TRY(importImage(path, bytes, options, part));
    }
    else
        HEARTH_TRY(importScan(path, bytes, options, part));
    return file.checkUnchanged();
}

} // namespace hearth::import
