// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/buffers.h"

#include "formats/base/byte_reader.h"
#include "pipelines/import/gltf/document/meshopt.h"
#include "pipelines/import/gltf/document/uri.h"

#include <fmt/format.h>

namespace hearth::import
{

namespace
{

using Bytes = std::span<const std::byte>;

/// Truncate a URI for a message: data URIs can be megabytes long.
std::string truncateUri(const std::string& uri)
{
    constexpr size_t kMax = 80;
    return uri.size() <= kMax ? uri : uri.substr(0, kMax) + "...";
}

/// Return a flag for each buffer: true if it must exist. A buffer may be absent if only compressed views use
/// it, as their fallback.
std::vector<bool> findRequiredBuffers(const GltfModel& model)
{
    std::vector<bool> needed(model.buffers.size());
    for (size_t i = 0; i < model.buffers.size(); ++i)
        needed[i] = model.buffers[i].uri && !model.buffers[i].fallback;
    for (const GltfBufferView& view : model.buffer_views)
        needed[view.meshopt ? view.meshopt->buffer : view.buffer] = true;
    return needed;
}

/// Refuse a buffer that is shorter than it says. One that nothing uses gets a warning.
Status checkShortBuffer(const GltfBuffer& buffer, size_t index, bool is_needed, size_t size,
                        const GltfContext& context)
{
    const std::string where = fmt::format("/buffers/{}", index);
    const std::string lengths =
        fmt::format("byteLength is {}, but there are {} bytes", buffer.byte_length, size);
    if (is_needed)
        return context.error(Issue::buffer_short, where, lengths);
    context.part.warn(Issue::inconsistent, where, lengths + "; nothing uses the buffer");
    return success();
}

Result<FileBytes> readBufferUri(const std::string& uri, const std::string& where, const GltfContext& context)
{
    Result<FileBytes> bytes = readUri(uri, where + "/uri", context);
    if (!bytes.ok() && bytes.error().issue == Issue::input_missing)
        return context.error(Issue::buffer_missing, where + "/uri",
                             bytes.error().detail + suggestNearestForUri(uri, Issue::input_missing, context));
    return bytes;
}

} // namespace

Result<FileBytes> readUri(const std::string& uri, const std::string& where, const GltfContext& context)
{
    if (isDataUri(uri))
    {
        std::optional<std::vector<std::byte>> bytes = decodeDataUri(uri);
        if (bytes)
            return FileBytes(std::move(*bytes));
        return context.error(Issue::uri_malformed, where, "the data URI is not valid base64");
    }
    const std::optional<std::string> path = decodePercent(uri);
    if (!path)
        return context.error(Issue::uri_malformed, where,
                             fmt::format("\"{}\" has a '%' without two digits", truncateUri(uri)));
    Result<FileBytes> file = context.folder.read(*path, context.options.limits.max_file_bytes);
    if (!file.ok())
        return context.error(file.error().issue, where,
                             fmt::format("\"{}\" beside {}: {}", truncateUri(*path),
                                         context.folder.assetName(), file.error().detail));
    context.part.addSource(*path, file->bytes().size(), file->hash());
    return file;
}

std::string suggestNearestForUri(const std::string& uri, Issue issue, const GltfContext& context)
{
    const std::optional<std::string> path = isDataUri(uri) ? std::nullopt : decodePercent(uri);
    return path ? context.folder.suggestNearest(*path, issue) : "";
}

Result<GltfBuffers> GltfBuffers::load(const GltfModel& model, const FileBytes& source,
                                      const GltfContainer& container, const GltfContext& context)
{
    GltfBuffers result(source);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Bytes> buffers, result.loadBuffers(model, container, context));
    HEARTH_TRY(result.makeViews(model, buffers, context));
    return result;
}

Result<std::vector<Bytes>> GltfBuffers::loadBuffers(const GltfModel& model, const GltfContainer& container,
                                                    const GltfContext& context)
{
    const std::vector<bool> needed = findRequiredBuffers(model);
    std::vector<Bytes> buffers(model.buffers.size());
    for (size_t i = 0; i < buffers.size(); ++i)
    {
        const GltfBuffer& buffer = model.buffers[i];
        const std::string where = fmt::format("/buffers/{}", i);
        const bool in_container = i == 0 && !buffer.uri && container.binary;
        if (!needed[i] && (!in_container || buffer.fallback))
            continue;
        if (buffer.uri)
        {
            HEARTH_ASSIGN_OR_RETURN(FileBytes bytes, readBufferUri(*buffer.uri, where, context));
            owned_.push_back(std::move(bytes));
            buffers[i] = owned_.back().bytes();
        }
        else if (in_container)
            buffers[i] = *container.binary;
        else
            return context.error(Issue::buffer_missing, where,
                                 "the buffer has neither a URI nor a BIN chunk");
        if (buffers[i].size() < buffer.byte_length)
            HEARTH_TRY(checkShortBuffer(buffer, i, needed[i], buffers[i].size(), context));
    }
    return buffers;
}

Status GltfBuffers::makeViews(const GltfModel& model, std::span<const Bytes> buffers,
                              const GltfContext& context)
{
    for (size_t i = 0; i < model.buffer_views.size(); ++i)
    {
        const GltfBufferView& view = model.buffer_views[i];
        const std::string where = fmt::format("/bufferViews/{}", i);
        Bytes bytes;
        if (view.meshopt)
        {
            const auto compressed = checkedPart(buffers[view.meshopt->buffer], view.meshopt->byte_offset,
                                                view.meshopt->byte_length);
            HEARTH_ASSERT(compressed.has_value()); // the model has checked it against byteLength
            HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> decoded,
                                    decodeMeshopt(*view.meshopt, *compressed, context.file, where));
            if (decoded.size() < view.byte_length)
                return context.error(Issue::gltf_bounds, where,
                                     fmt::format("{} bytes were compressed, but byteLength is {}",
                                                 decoded.size(), view.byte_length));
            owned_.emplace_back(std::move(decoded));
            bytes = owned_.back().bytes().first(view.byte_length);
        }
        else
        {
            const auto part = checkedPart(buffers[view.buffer], view.byte_offset, view.byte_length);
            HEARTH_ASSERT(part.has_value());
            bytes = *part;
        }
        views_.push_back(bytes);
    }
    return success();
}

void GltfBuffers::releasePages() const
{
    source_->releasePages();
    for (const FileBytes& file : owned_)
        file.releasePages();
}

Status GltfBuffers::checkUnchanged() const
{
    for (const FileBytes& file : owned_)
        HEARTH_TRY(file.checkUnchanged());
    return success();
}

} // namespace hearth::import
