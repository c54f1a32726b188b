// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/estimates/estimate.h"

#include "cook/json/json.h"
#include "cook/texels/search/error_estimate.h"
#include "cook/texels/texel_source.h"
#include "cook/tools/sha256.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::estimates
{

using namespace formats;
using namespace texels;

namespace
{

/// Return the square of the larger part of its target that an error takes, times the texels of the image.
double findCost(const PlainImage& image, const ImageError& error, const Target& target)
{
    const double share = std::max(error.error / target.error, error.smooth / target.smooth);
    return share * share * static_cast<double>(uint64_t{image.record.width} * image.record.height);
}

/// Return a hash of all that encoders read of an image.
std::string hashContent(const PlainImage& image)
{
    const ImageRecord& record = image.record;
    return tools::computeSha256(fmt::format("{} {} {} {} {} {} {}\n{}", record.width, record.height,
                                            record.mip_count, record.format, static_cast<int>(image.role),
                                            image.channels, image.record.alpha_cutoff,
                                            tools::computeSha256(image.mips)));
}

EstimatedImage estimateImage(const LoadedImage& loaded, const Request& request)
{
    const PlainImage& image = loaded.image;
    const ImageDetail detail(image);
    EstimatedImage estimated{.name = loaded.name, .content = hashContent(image)};
    for (const Candidate& candidate : request.candidates)
    {
        // a budget is spent on compressed formats, however large it is
        if (candidate.traits->family == TexelFamily::plain && request.candidates.size() > 1)
            continue;
        ImageRecord record = image.record;
        record.format = static_cast<uint32_t>(candidate.traits->format);
        estimated.formats.push_back(
            {.name = candidate.traits->name, .bytes = mipOffset(record, record.mip_count)});
        // a single one costs the same whatever the budget
        if (request.candidates.size() > 1)
        {
            ErrorEstimate estimate(image, detail, candidate, request.effort);
            estimate.refine();
            estimated.formats.back().cost = findCost(image, estimate.error(), request.target);
        }
    }
    return estimated;
}

} // namespace

Result<std::vector<EstimatedImage>>
estimateTexels(const std::string& import_path, const std::string& textures_path, const TexelOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const TexelSource source, TexelSource::open(import_path, textures_path));
    std::vector<EstimatedImage> images;
    for (uint32_t i = 0; i < source.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const LoadedImage loaded, source.load(i));
        HEARTH_ASSIGN_OR_RETURN(const Request request,
                                makeRequest(loaded.image, options, i, loaded.name, loaded.place));
        images.push_back(estimateImage(loaded, request));
    }
    return images;
}

std::string estimatesJson(const std::string& source, const std::vector<EstimatedImage>& images)
{
    Json json{{"schema", "hearth.estimates/1"}, {"source", source}, {"images", Json::array()}};
    for (const EstimatedImage& image : images)
    {
        Json formats = Json::array();
        for (const EstimatedFormat& format : image.formats)
            formats.push_back(
                {{"format", std::string(format.name)}, {"bytes", format.bytes}, {"cost", format.cost}});
        json["images"].push_back({{"name", image.name}, {"content", image.content}, {"formats", formats}});
    }
    return json.dump(2) + "\n";
}

} // namespace hearth::estimates
