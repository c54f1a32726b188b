// The bytes behind a glTF file's buffer views.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/container.h"
#include "pipelines/import/gltf/document/model.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/source/asset_folder.h"
#include "pipelines/import/source/file_bytes.h"

namespace hearth::import
{

/// What the readers of a document share.
struct GltfContext
{
    const std::string& file; ///< the asset, as the user named it
    const AssetFolder& folder;
    const ImportOptions& options;
    PartBuilder& part;

    Error error(Issue issue, std::string where, std::string detail) const
    {
        return {issue, file, std::move(where), std::move(detail)};
    }
};

/// The bytes that a URI stands for: those of a data URI, or of a file in the asset's folder, which is noted as a
/// source. errors: uri_malformed, uri_outside, input_missing, input_too_large, read_failed.
Result<FileBytes> readUri(const std::string& uri, const std::string& where, const GltfContext& context);

/// As AssetFolder::suggestionFor, where readUri has failed with the issue; empty for a data URI.
std::string suggestionForUri(const std::string& uri, Issue issue, const GltfContext& context);

/// Owns the buffers and the decompressed views. All views are decompressed when it is made, used or not.
class GltfBuffers
{
public:
    /// errors: those of readUri, buffer_missing, buffer_short, codec_failed, gltf_bounds.
    /// source  that the container lies in; it outlives this
    static Result<GltfBuffers> load(const GltfModel& model, const FileBytes& source,
                                    const GltfContainer& container, const GltfContext& context);

    std::span<const std::byte> view(uint32_t index) const { return views_[index]; }

    /// Whatever lies in mapped files leaves the memory until it is looked at again.
    void forget() const;

    /// errors: read_failed where a file of the buffers has changed since.
    Status unchanged() const;

private:
    explicit GltfBuffers(const FileBytes& source) : source_(&source) {}

    const FileBytes* source_;
    std::vector<FileBytes> owned_;
    std::vector<std::span<const std::byte>> views_;
};

} // namespace hearth::import
