// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/texels/texel_part.h"
#include "formats/pack/image_error.h"

#include <cmath>

namespace hearth::texels
{

using namespace formats;

namespace
{

/// Convert an error to the unit of its role, beside the number of the record.
Json errorJson(ImageRole role, double error)
{
    const double converted = convertImageError(role, error);
    return {{"rms", error},
            {std::string(imageErrorUnit(role)), std::isfinite(converted) ? Json(converted) : Json(nullptr)}};
}

const char* reasonName(FormatReason reason)
{
    return reason == FormatReason::rule ? "rule" : reason == FormatReason::budget ? "budget" : "target";
}

/// Return the candidates that the search looked at, by bytes on the GPU.
Json estimatesJson(const ImageResult& image, ImageRole role)
{
    Json list = Json::array();
    for (const CandidateError& estimate : image.estimates)
    {
        ImageRecord record = image.record;
        record.format = static_cast<uint32_t>(estimate.candidate.traits->format);
        list.push_back({{"format", std::string(estimate.candidate.traits->name)},
                        {"bytes", mipOffset(record, record.mip_count)},
                        {"error", errorJson(role, estimate.error.error)},
                        {"error_smooth", errorJson(role, estimate.error.smooth)}});
    }
    return list;
}

/// Return the place of the pictures of an image in the sheet, and what their brightest colour stands for.
Json pictureJson(const TexelResults& results, const ImageResult& image)
{
    const SheetPlace place = findSheetPlace(*image.picture);
    const Picture& thumbnail = results.pictures[*image.picture].thumbnail;
    const auto role = static_cast<ImageRole>(image.record.role);
    return {{"x", place.x},
            {"y", place.y},
            {"error_x", place.x + kPictureSide},
            {"width", thumbnail.width},
            {"height", thumbnail.height},
            {"brightest", errorJson(role, kPictureScale * double{image.record.error})}};
}

Json imageJson(const TexelResults& results, size_t index)
{
    const ImageResult& image = results.images[index];
    const auto role = static_cast<ImageRole>(image.record.role);
    Json json{
        {"index", index},
        {"name", image.name},
        {"width", image.record.width},
        {"height", image.record.height},
        {"mips", image.record.mip_count},
        {"format", std::string(texelFormatName(image.record.format))},
        {"role", std::string(imageRoleName(image.record.role))},
        {"bytes", image.bytes},
        {"bytes_stored", image.stored_bytes},
        {"error", errorJson(role, double{image.record.error})},
        {"error_p999", errorJson(role, double{image.record.error_p999})},
        {"error_smooth", errorJson(role, double{image.record.error_smooth})},
        {"coverage_error", image.record.coverage_error},
        {"target", errorJson(role, image.target.error)},
        {"target_smooth", std::isfinite(image.target.smooth) ? errorJson(role, image.target.smooth) : Json()},
        {"holds_target", image.holds_target},
        {"reason", reasonName(image.reason)},
        {"estimates", estimatesJson(image, role)}};
    if (image.picture)
        json["picture"] = pictureJson(results, image);
    return json;
}

} // namespace

std::string statisticsJson(const std::string& source, const TexelResults& results)
{
    Json json{{"schema", "hearth.texels/1"}, {"source", source}, {"images", Json::array()}};
    for (size_t i = 0; i < results.images.size(); ++i)
        json["images"].push_back(imageJson(results, i));
    return json.dump(2) + "\n";
}

} // namespace hearth::texels
