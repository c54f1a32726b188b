// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_request.h"

#include "formats/pack/image_error.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::texels
{

using namespace formats;

namespace
{

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

} // namespace

Result<Request> makeRequest(const PlainImage& image, const TexelOptions& options, uint32_t index,
                            const std::string& name, Error error)
{
    TextureChoice choice = resolveChoice(
        options.rules, {.quality = options.quality, .families = options.families}, image.role, name);
    Request request{.candidates = listCandidates(image, *choice.families), .effort = *choice.quality};
    if (!choice.target)
        request.target = findTarget(image, request.effort);
    else
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
    const auto chosen = options.formats.find(index);
    if (choice.format.empty() && chosen != options.formats.end())
    {
        choice.format = chosen->second;
        request.reason = FormatReason::budget;
    }
    else if (!choice.format.empty())
        request.reason = FormatReason::rule;
    if (!choice.format.empty())
        HEARTH_TRY(keepNamed(image, choice, std::move(error), request.candidates));
    return request;
}

} // namespace hearth::texels
