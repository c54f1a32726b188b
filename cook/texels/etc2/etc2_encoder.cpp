// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/etc2_encoder.h"

#include "cook/texels/etc2/block_bits.h"
#include "cook/texels/etc2/eac_encoder.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

/// Error from which on the modes T and H are tried: their codes of 4 bits are seldom better below.
int32_t findPaintThreshold(Effort effort)
{
    return effort == Effort::high ? 0 : effort == Effort::normal ? 40 : 1200;
}

} // namespace

Etc2Encoder::Etc2Encoder(Effort effort, ColorWeights weights) : effort_(effort), tables_(weights) {}

EncodedColors Etc2Encoder::encodeRgb(const Block8& block) const
{
    const ColorWeights& weights = tables_.weights;
    const HalvesSolution halves = searchHalves(block, tables_, effort_);
    const PlanarSolution planar = searchPlanar(block, weights, effort_, halves.error);
    int32_t least = std::min(halves.error, planar.error);
    PaintSolution paints;
    if (least > findPaintThreshold(effort_))
    {
        paints = searchPaints(block, tables_, effort_, least);
        least = std::min(least, paints.error);
    }
    const auto error = static_cast<uint32_t>(least);
    if (least == halves.error)
        return {writeHalves(block, halves, weights), error};
    if (least == planar.error)
        return {writePlanar(planar), error};
    return {writePaints(block, paints, weights), error};
}

EncodedRgba Etc2Encoder::encodeRgba(const Block8& block) const
{
    std::array<uint8_t, 16> alpha;
    for (size_t t = 0; t < 16; ++t)
        alpha[t] = block[t][3];
    const EncodedAlpha encoded_alpha = encodeEacAlpha(alpha, effort_);
    const EncodedColors colors = encodeRgb(block);
    EncodedRgba encoded;
    std::copy(encoded_alpha.bytes.begin(), encoded_alpha.bytes.end(), encoded.bytes.begin());
    std::copy(colors.bytes.begin(), colors.bytes.end(), encoded.bytes.begin() + 8);
    encoded.color_error = colors.error;
    encoded.alpha_error = encoded_alpha.error;
    return encoded;
}

} // namespace hearth::texels
