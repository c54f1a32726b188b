// Reads the bytes of a glTF file's buffer views.
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

/// Shared state of the readers of a document.
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

/// Read the bytes of a data URI, or of a file in the asset's folder, which is registered as a source.
/// errors: uri_malformed, uri_outside, input_missing, input_too_large, read_failed.
Result<FileBytes> readUri(const std::string& uri, const std::string& where, const GltfContext& context);

/// Return AssetFolder::suggestNearest, after readUri has failed with the issue; empty for a data URI.
std::string suggestNearestForUri(const std::string& uri, Issue issue, const GltfContext& context);

/// Buffers and decompressed views of a document. All views are decompressed on load, used or not.
class GltfBuffers
{
public:
    /// Load all buffers. A buffer that is shorter than it says is refused; a warning if nothing uses it.
    /// errors: those of readUri, buffer_missing, buffer_short, codec_failed, gltf_bounds.
    /// source  file of the container; outlives this object
    static Result<GltfBuffers> load(const GltfModel& model, const FileBytes& source,
                                    const GltfContainer& container, const GltfContext& context);

    std::span<const std::byte> view(uint32_t index) const { return views_[index]; }

    /// Drop the pages of mapped files from memory until they are accessed again.
    void releasePages() const;

    /// Check that the files of the buffers have not changed. errors: read_failed.
    Status checkUnchanged() const;

private:
    explicit GltfBuffers(const FileBytes& source) : source_(&source) {}
    Result<std::vector<std::span<const std::byte>>>
    loadBuffers(const GltfModel& model, const GltfContainer& container, const GltfContext& context);
    Status makeViews(const GltfModel& model, std::span<const std::span<const std::byte>> buffers,
                     const GltfContext& context);

    const FileBytes* source_;
    std::vector<FileBytes> owned_;
    std::vector<std::span<const std::byte>> views_;
};

} // namespace hearth::import
