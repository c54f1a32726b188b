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

/// Choose blocks with chances that are proportional to what is expected of them. The sum of any quantity of
/// the chosen blocks times their weights estimates its sum over all blocks without bias, and the better, the
/// more the quantity is proportional to what was expected. Blocks with the largest expectations are all
/// chosen.
/// Source: Tille, "Sampling Algorithms", 2006, sections 5.6 (chances) and 7.1 (systematic choice), with one
/// place in each step.
/// expected  [block]: positive where the quantity may be
/// wanted    number of blocks; those that are chosen twice make it less
/// before    blocks that other samples have: the choice differs from theirs
/// returns   ascending by block; the same for the same input
std::vector<SampledBlock> sampleBlocks(std::span<const float> expected, size_t wanted, size_t before = 0);

} // namespace hearth::texels
