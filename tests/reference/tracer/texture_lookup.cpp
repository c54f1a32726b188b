// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/texture_lookup.h"

#include "formats/base/half.h"
#include "formats/pack/decode_image.h"
#include "formats/texels/swizzle.h"
#include "tests/reference/png_image.h"

#include <algorithm>
#include <cmath>

namespace hearth::reference
{

using namespace formats;

namespace
{

/// Decode IEEE 754 binary16.
double decodeHalf(uint16_t bits)
{
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const double sign = bits & 0x8000 ? -1 : 1;
    if (exponent == 31)
        return sign * (mantissa == 0 ? HUGE_VAL : 0);
    return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25));
}

/// Index of the texel that a coordinate outside the image maps to.
int64_t wrapped(int64_t i, int64_t size, uint8_t mode)
{
    switch (static_cast<Wrap>(mode))
    {
    case Wrap::clamp_to_edge:
        return std::clamp<int64_t>(i, 0, size - 1);
    case Wrap::mirrored_repeat:
    {
        const int64_t k = ((i % (2 * size)) + 2 * size) % (2 * size);
        return k < size ? k : 2 * size - 1 - k;
    }
    case Wrap::repeat:
        break;
    }
    return ((i % size) + size) % size;
}

Rgba mixed(const Rgba& a, const Rgba& b, double t)
{
    return {a.rgb * (1 - t) + b.rgb * t, a.alpha * (1 - t) + b.alpha * t};
}

} // namespace

Result<TextureSet> TextureSet::load(const PackView& view)
{
    TextureSet set(view);
    for (uint32_t i = 0; i < view.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, view.imageData(i));
        const ImageRecord& record = view.images()[i];
        std::vector<std::vector<DecodedTexel>>& mips = set.images_.emplace_back();
        for (uint32_t mip = 0; mip < record.mip_count; ++mip)
            mips.push_back(decodeImageMip(record, data.bytes(), mip));
    }
    return set;
}

Rgba TextureSet::texel(uint32_t image, uint32_t mip, int64_t x, int64_t y) const
{
    const ImageRecord& record = view_->images()[image];
    const TexelCoding coding = findTexelFormat(record.format)->coding;
    const bool is_float = coding == TexelCoding::float_value;
    const uint64_t index = static_cast<uint64_t>(y) * mipExtent(record, mip).width + static_cast<uint64_t>(x);
    const DecodedTexel texel =
        applySwizzle(images_[image][mip][index], record.swizzle, is_float ? kHalfOne : uint16_t{0xFFFF});
    double c[4];
    std::transform(texel.begin(), texel.end(), c,
                   [&](uint16_t word) { return is_float ? decodeHalf(word) : word / 65535.0; });
    if (coding == TexelCoding::srgb)
        std::transform(c, c + 3, c, linearFromSrgb);
    return {{c[0], c[1], c[2]}, c[3]};
}

Rgba TextureSet::bilinear(const TextureRef& texture, uint32_t mip, double u, double v) const
{
    const MipExtent size = mipExtent(view_->images()[texture.image], mip);
    const auto at = [&](int64_t x, int64_t y)
    {
        return texel(texture.image, mip, wrapped(x, size.width, texture.wrap_u),
                     wrapped(y, size.height, texture.wrap_v));
    };
    if (texture.nearest)
        return at(static_cast<int64_t>(std::floor(u * size.width)),
                  static_cast<int64_t>(std::floor(v * size.height)));
    const double x = u * size.width - 0.5, y = v * size.height - 0.5;
    const auto ix = static_cast<int64_t>(std::floor(x)), iy = static_cast<int64_t>(std::floor(y));
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    return mixed(mixed(at(ix, iy), at(ix + 1, iy), fx), mixed(at(ix, iy + 1), at(ix + 1, iy + 1), fx), fy);
}

Rgba TextureSet::sample(const TextureRef& texture, Float2 uv, double footprint) const
{
    if (texture.image == kInvalidIndex)
        return {};
    const float* m = texture.uv_transform;
    const double u = double{m[0]} * double{uv.x} + double{m[1]} * double{uv.y} + double{m[2]};
    const double v = double{m[3]} * double{uv.x} + double{m[4]} * double{uv.y} + double{m[5]};
    const double scale = std::sqrt(std::abs(double{m[0]} * double{m[4]} - double{m[1]} * double{m[3]}));
    const ImageRecord& image = view_->images()[texture.image];
    const double texels = footprint * scale * std::sqrt(1.0 * image.width * image.height);
    const double level =
        std::clamp(std::log2(std::max(texels, 1e-6)), 0.0, static_cast<double>(image.mip_count - 1));
    const auto mip = static_cast<uint32_t>(level);
    const Rgba fine = bilinear(texture, mip, u, v);
    if (mip + 1 >= image.mip_count)
        return fine;
    return mixed(fine, bilinear(texture, mip + 1, u, v), level - mip);
}

} // namespace hearth::reference
