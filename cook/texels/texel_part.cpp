// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_part.h"

#include "cook/texels/texel_source.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/image_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

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
    const std::vector<bool> pictured = selectPictured(source.images(), options);
    for (uint32_t i = 0; i < source.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const LoadedImage loaded, source.load(i));
        const PlainImage& image = loaded.image;
        HEARTH_ASSIGN_OR_RETURN(const Request request,
                                makeRequest(image, options, i, loaded.name, loaded.place));
        const Encoding encoding = encodeRequest(image, request, options.strict);
        records.push_back(describe(image, request, encoding));
        HEARTH_TRY(addImageData(writer, i, records.back(), encoding.texels));
        results.images.push_back({.name = loaded.name,
                                  .record = records.back(),
                                  .target = request.target,
                                  .holds_target = holdsTargets(records.back()),
                                  .reason = request.reason,
                                  .estimates = encoding.estimates,
                                  .bytes = encoding.texels.size()});
        if (pictured[i])
        {
            results.images.back().picture = results.pictures.size();
            results.pictures.push_back(drawPictures(image, encoding));
        }
    }
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
