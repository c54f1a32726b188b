// Finds the format with the fewest bytes that keeps the error of an image below a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/encode.h"
#include "cook/texels/search/target.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Error of a candidate, estimated or measured.
struct CandidateError
{
    Candidate candidate{};
    ImageError error{};
};

struct Encoding
{
    Candidate candidate{};
    std::vector<std::byte> texels{}; ///< as encodeImage
    ImageError error{};
    double share = 0; ///< larger part of its target that an error takes; at most 1 if it holds the target
    std::vector<CandidateError> estimates{}; ///< of the candidates that the search looked at
};

/// Encode an image in the cheapest candidate that holds the target over the measured mips; where none does,
/// in the compressed one that is nearest to it, or, if `strict`, in the plain format.
/// candidates  as listCandidates: ascending by bytes, the plain one last
Encoding encodeForTarget(const PlainImage& image, std::span<const Candidate> candidates, const Target& target,
                         Effort effort, bool strict);

/// Encode an image in the format of a candidate, whether it holds the target or not.
Encoding encodeCandidate(const PlainImage& image, const Candidate& candidate, const Target& target,
                         Effort effort);

} // namespace hearth::texels
