// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_part.h"

#include "cook/texels/texel_source.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/image_error.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Images in memory. A plain one of 16,384 x 16,384 texels has 1.4 GiB.
constexpr size_t kMaxImagesAtOnce = 4;

/// Store the target that chose the format. A rule or a budget that names one asks for no error.
void describeTarget(const Request& request, ImageRecord& record)
{
    if (request.reason != FormatReason::target)
        return;
    record.target = static_cast<float>(request.target.error);
    if (std::isfinite(request.target.smooth))
        record.target_smooth = static_cast<float>(request.target.smooth);
}

/// Return the record of an encoded image.
ImageRecord describe(const PlainImage& image, const Request& request, const Encoding& encoding)
{
    ImageRecord record = image.record;
    record.format = static_cast<uint32_t>(encoding.candidate.traits->format);
    record.role = static_cast<uint8_t>(image.role);
    for (uint32_t c = 0; c < 4; ++c)
        record.swizzle[c] = static_cast<uint8_t>(encoding.candidate.swizzle[c]);
    record.error = static_cast<float>(encoding.error.error);
    record.error_p999 = static_cast<float>(encoding.error.error_p999);
    record.error_smooth = static_cast<float>(encoding.error.smooth);
    record.coverage_error = static_cast<float>(encoding.error.coverage);
    describeTarget(request, record);
    return record;
}

Encoding encodeRequest(const PlainImage& image, const Request& request, bool strict)
{
    if (request.reason != FormatReason::target)
        return encodeCandidate(image, request.candidates.front(), request.target, request.effort);
    return encodeForTarget(image, request.candidates, request.target, request.effort, strict);
}

/// Select the images that pictures are drawn of: the largest.
std::vector<bool> selectPictured(std::span<const ImageRecord> images, const TexelOptions& options)
{
    std::vector<bool> selected(images.size(), false);
    std::vector<size_t> order(options.draws_pictures ? images.size() : 0);
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](size_t i) { return uint64_t{images[i].width} * images[i].height; });
    order.resize(std::min(order.size(), kMaxPictures));
    for (const size_t i : order)
        selected[i] = true;
    return selected;
}

/// An image that is ready to be written.
struct EncodedImage
{
    ImageResult result{};
    std::vector<std::byte> texels{};
    std::optional<PicturePair> picture{};
};

Result<EncodedImage> encodeLoaded(const LoadedImage& loaded, uint32_t index, const TexelOptions& options,
                                  bool is_pictured)
{
    const PlainImage& image = loaded.image;
    HEARTH_ASSIGN_OR_RETURN(const Request request,
                            makeRequest(image, options, index, loaded.name, loaded.place));
    Encoding encoding = encodeRequest(image, request, options.strict);
    const ImageRecord record = describe(image, request, encoding);
    EncodedImage encoded{.result = {.name = loaded.name,
                                    .record = record,
                                    .target = request.target,
                                    .holds_target = holdsTargets(record),
                                    .reason = request.reason,
                                    .estimates = encoding.estimates,
                                    .bytes = encoding.texels.size()}};
    if (is_pictured)
        encoded.picture = drawPictures(image, encoding);
    encoded.texels = std::move(encoding.texels);
    return encoded;
}

/// Load and encode all images, a few at a time, since the search works on one thread, and write them in their
/// order. After the first error nothing is written.
/// write  Status(EncodedImage)
template <typename Write>
Status encodeImages(const TexelSource& source, const TexelOptions& options, const Write& write)
{
    struct Work
    {
        uint32_t index;
        Result<LoadedImage> loaded;
    };
    const std::vector<bool> pictured = selectPictured(source.images(), options);
    std::atomic<bool> has_failed = false;
    Status status = success();
    uint32_t next = 0;
    const auto load = [&](tbb::flow_control& flow) -> std::shared_ptr<Work>
    {
        if (next == source.images().size() || has_failed)
        {
            flow.stop();
            return nullptr;
        }
        const uint32_t index = next++;
        return std::make_shared<Work>(Work{index, source.load(index)});
    };
    const auto encode = [&](const std::shared_ptr<Work>& work)
    {
        return std::make_shared<Result<EncodedImage>>(
            work->loaded.ok() ? encodeLoaded(*work->loaded, work->index, options, pictured[work->index])
                              : Result<EncodedImage>(work->loaded.error()));
    };
    const auto finish = [&](const std::shared_ptr<Result<EncodedImage>>& encoded)
    {
        if (has_failed)
            return;
        status = encoded->ok() ? write(std::move(**encoded)) : Status(encoded->error());
        has_failed = !status.ok();
    };
    tbb::parallel_pipeline(
        kMaxImagesAtOnce,
        tbb::make_filter<void, std::shared_ptr<Work>>(tbb::filter_mode::serial_in_order, load) &
            tbb::make_filter<std::shared_ptr<Work>, std::shared_ptr<Result<EncodedImage>>>(
                tbb::filter_mode::parallel, encode) &
            tbb::make_filter<std::shared_ptr<Result<EncodedImage>>, void>(tbb::filter_mode::serial_in_order,
                                                                          finish));
    return status;
}

/// Add the size of each image in the written part.
Status addStoredBytes(const std::string& path, std::span<ImageResult> results)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(path, Check::structure));
    for (uint32_t i = 0; i < results.size(); ++i)
        if (const ChunkEntry* entry = part.find(kChunkImageData, i); entry != nullptr)
            results[i].stored_bytes = entry->stored_size;
    return success();
}

} // namespace

Status cookTexels(const std::string& import_path, const std::string& textures_path,
                  const std::string& output_path, const TexelOptions& options, TexelResults& results)
{
    HEARTH_ASSIGN_OR_RETURN(const TexelSource source, TexelSource::open(import_path, textures_path));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    std::vector<ImageRecord> records;
    const auto write = [&](EncodedImage image) -> Status
    {
        const auto index = static_cast<uint32_t>(records.size());
        records.push_back(image.result.record);
        HEARTH_TRY(addImageData(writer, index, image.result.record, image.texels));
        results.images.push_back(std::move(image.result));
        if (image.picture)
        {
            results.images.back().picture = results.pictures.size();
            results.pictures.push_back(*std::move(image.picture));
        }
        return success();
    };
    HEARTH_TRY(encodeImages(source, options, write));
    if (!source.changedStrings().empty())
        HEARTH_TRY(writer.addText(kChunkStrings, source.changedStrings()));
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, records));
    if (!source.changedMaterials().empty())
        HEARTH_TRY(writer.addRecords<MaterialRecord>(kChunkMaterials, source.changedMaterials()));
    if (!source.changedLayers().empty())
        HEARTH_TRY(writer.addRecords<MaterialLayersRecord>(kChunkMaterialLayers, source.changedLayers()));
    HEARTH_TRY(writer.finish());
    return addStoredBytes(output_path, results.images);
}

} // namespace hearth::texels
