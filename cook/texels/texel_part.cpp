// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_part.h"

#include "cook/texels/role.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/image_error.h"
#include "formats/pack/pack_check.h"
#include "formats/pack/part_materials.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

Result<PackView> openPart(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
    return PackView::read(std::move(reader));
}

/// Check what the encoders take for granted of an image of the textures part.
Status checkPlain(const PackView& textures, uint32_t index, std::span<const std::byte> mips)
{
    const ImageRecord& image = textures.images()[index];
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kMaxImageSize || image.height == 0 ||
        image.height > kMaxImageSize || image.mip_count == 0 || image.mip_count > 32 ||
        texelBytes(image.format) < 4)
        return Error{Issue::meaning_value, textures.name(), where,
                     std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " texels of format " + std::to_string(image.format)};
    if (mips.size() != mipOffset(image, image.mip_count))
        return Error{Issue::chunk_size, textures.name(), chunkName(kChunkImageData, index),
                     std::to_string(mips.size()) + " bytes, its mips have " +
                         std::to_string(mipOffset(image, image.mip_count))};
    return success();
}

/// Return the record of an encoded image.
ImageRecord describe(const PlainImage& image, const Encoding& encoding)
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
    return record;
}

/// Format or error that an image shall have.
struct Request
{
    std::vector<Candidate> candidates{}; ///< as listCandidates; one if a rule names a format
    Target target{};
    Effort effort = Effort::normal;
    FormatReason reason = FormatReason::target;
};

/// Ranges of targets in the units of roles: what lies beyond is meant for another role.
struct TargetRange
{
    double low;
    double high;
};

TargetRange targetRange(ImageRole role)
{
    if (role == ImageRole::normal)
        return {0.1, 45};
    return role == ImageRole::light ? TargetRange{0.001, 4} : TargetRange{10, 100};
}

/// Keep the candidate that a rule names. errors: `error` with the formats that suit the image
Status keepNamed(const PlainImage& image, const TextureChoice& choice, Error error,
                 std::vector<Candidate>& candidates)
{
    const auto found = std::ranges::find_if(candidates, [&](const Candidate& candidate)
                                            { return matchesFormat(choice.format, *candidate.traits); });
    if (found != candidates.end())
    {
        candidates = {*found};
        return success();
    }
    std::vector<std::string_view> names;
    for (const Candidate& candidate : candidates)
        names.push_back(candidate.traits->name);
    error.detail = fmt::format("\"{}\" does not suit role {} with families {}; suitable are {}",
                               choice.format, imageRoleName(static_cast<uint32_t>(image.role)),
                               familiesText(*choice.families), fmt::join(names, ", "));
    return error;
}

/// Resolve the rules for an image. errors: `error` with a detail, where a rule does not suit the image
Result<Request> makeRequest(const PlainImage& image, const TexelOptions& options, const std::string& name,
                            Error error)
{
    const TextureChoice choice = resolveChoice(
        options.rules, {.quality = options.quality, .families = options.families}, image.role, name);
    Request request{.candidates = listCandidates(image, *choice.families), .effort = *choice.quality};
    request.target = findTarget(image, request.effort);
    if (choice.target)
    {
        const auto [low, high] = targetRange(image.role);
        if (*choice.target < low || *choice.target > high)
        {
            error.detail = fmt::format("target {} is not between {} and {}: it is in {} for role {}",
                                       *choice.target, low, high,
                                       image.role == ImageRole::normal  ? "degrees"
                                       : image.role == ImageRole::light ? "stops"
                                                                        : "decibels",
                                       imageRoleName(static_cast<uint32_t>(image.role)));
            return error;
        }
        request.target = makeTarget(image.role, request.effort, *choice.target);
    }
    if (!choice.format.empty())
    {
        HEARTH_TRY(keepNamed(image, choice, std::move(error), request.candidates));
        request.reason = FormatReason::rule;
    }
    return request;
}

Encoding encodeRequest(const PlainImage& image, const Request& request, bool strict)
{
    if (request.reason == FormatReason::rule)
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
    HEARTH_ASSIGN_OR_RETURN(const PackView import_part, openPart(import_path));
    HEARTH_ASSIGN_OR_RETURN(const PackView textures, openPart(textures_path));
    const size_t count = textures.images().size();
    if (!matchesImages(import_part, textures))
        return Error{Issue::meaning_reference, textures_path, "",
                     "has " + std::to_string(count) + " images where the import part has " +
                         std::to_string(import_part.images().size())};
    const std::span<const MaterialRecord> materials = findMaterials(import_part, textures);
    const std::vector<std::vector<ImageUse>> uses =
        imageUses(materials, findMaterialLayers(import_part, textures), count);

    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    std::vector<ImageRecord> records;
    const std::vector<bool> pictured = selectPictured(textures.images(), options);
    for (uint32_t i = 0; i < count; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, textures.imageData(i));
        HEARTH_TRY(checkPlain(textures, i, data.bytes()));
        PlainImage image{.record = textures.images()[i], .mips = data.bytes()};
        const ImageReads reads = findReads(image.record, uses[i], materials);
        image.role = reads.role;
        image.channels = reads.channels;

        const std::string name(import_part.text(image.record.name));
        HEARTH_ASSIGN_OR_RETURN(
            const Request request,
            makeRequest(image, options, name,
                        {Issue::texture_rule, import_path, fmt::format("image {} \"{}\"", i, name), ""}));
        const Encoding encoding = encodeRequest(image, request, options.strict);
        records.push_back(describe(image, encoding));
        HEARTH_TRY(addImageData(writer, i, records.back(), encoding.texels));
        results.images.push_back({.name = name,
                                  .record = records.back(),
                                  .target = request.target,
                                  .holds_target = encoding.share <= 1,
                                  .reason = request.reason,
                                  .estimates = encoding.estimates,
                                  .bytes = encoding.texels.size()});
        if (pictured[i])
        {
            results.images.back().picture = results.pictures.size();
            results.pictures.push_back(drawPictures(image, encoding));
        }
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, records));
    if (!textures.materials().empty())
        HEARTH_TRY(writer.addRecords<MaterialRecord>(kChunkMaterials, textures.materials()));
    if (!textures.materialLayers().empty())
        HEARTH_TRY(writer.addRecords<MaterialLayersRecord>(kChunkMaterialLayers, textures.materialLayers()));
    HEARTH_TRY(writer.finish());
    return addStoredBytes(output_path, results.images);
}

} // namespace hearth::texels
