// Chooses blocks of a mip that stand for all in an estimate.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Block that is looked at, and the number of blocks that it stands for: the inverse of its chance.
struct SampledBlock
{
    uint64_t block;
    double weight;

    bool operator==(const SampledBlock&) const = default;
};

/// Chooses blocks with chances that are proportional to what is expected of them. The sum of any quantity of
/// the chosen blocks times their weights estimates its sum over all blocks without bias, and the better, the
/// more the quantity is proportional to what was expected. Blocks with the largest expectations are all
/// chosen.
/// Source: Tille, "Sampling Algorithms", 2006, sections 5.6 (chances) and 7.1 (systematic choice), with one
/// place in each step.
class BlockSampler
{
public:
    /// expected  [block]: positive where the quantity may be; fewer than 2^32
    explicit BlockSampler(std::span<const float> expected);

    /// Return blocks, ascending; the same for the same input.
    /// wanted  number of blocks; those that are chosen twice make it less
    /// before  blocks that other samples have: the choice differs from theirs
    std::vector<SampledBlock> sample(size_t wanted, size_t before = 0) const;

private:
    std::vector<uint32_t> blocks_{}; ///< those of which something is expected, the most first
    std::vector<float> expected_{};  ///< [place in blocks_]
};

} // namespace hearth::texels
