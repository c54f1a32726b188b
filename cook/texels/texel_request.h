// Resolves options and rules into what one image shall have: an error below a target, or a format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/rules/texture_rules.h"
#include "cook/texels/search/search.h"
#include "formats/base/result.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hearth::texels
{

struct TexelOptions
{
    Families families{};
    Effort quality = Effort::normal; ///< target of error and effort of the encoders
    bool strict = false;             ///< an image that misses its target is not compressed
    TextureRules rules{};            ///< exceptions by role and by name
    /// formats of images by their numbers, as a budget of all textures shares its bytes: names as in rules
    std::map<uint32_t, std::string> formats{};
    bool draws_pictures = false; ///< pictures of the largest images, at most kMaxPictures
};

/// Reason why an image has its format.
enum class FormatReason : uint8_t
{
    target, ///< it has the fewest bytes of those that hold the target, or is the nearest to it
    rule,   ///< a rule names it
    budget, ///< a budget of all textures gives it so many bytes
};

struct Request
{
    std::vector<Candidate> candidates{}; ///< as listCandidates; one if a rule or a budget names a format
    Target target{};                     ///< bound of error; only a measure beside a named format
    Effort effort = Effort::normal;
    FormatReason reason = FormatReason::target;
};

/// Resolve the options for an image.
/// index, name  of the image
/// error        file and place of the image, for messages
/// errors: `error` with a detail, where a rule or a format does not suit the image
Result<Request> makeRequest(const PlainImage& image, const TexelOptions& options, uint32_t index,
                            const std::string& name, Error error);

} // namespace hearth::texels
