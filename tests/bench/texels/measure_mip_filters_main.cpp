// hearth_measure_mip_filters: compares the mips of real textures, and those that a Kaiser filter would make,
// with supersampled pictures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/texels/encoding/plain_image.h"
#include "cook/texels/role.h"
#include "formats/base/program.h"
#include "formats/pack/part_materials.h"
#include "tests/bench/aims.h"
#include "tests/reference/flip.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using texels::PlainImage;

using Color = std::array<double, 3>;

/// Texels in linear light.
struct LinearImage
{
    uint32_t width = 0, height = 0;
    std::vector<Color> texels{};

    /// Return the texel at a place, whose coordinates repeat.
    const Color& at(int64_t x, int64_t y) const
    {
        const int64_t column = (x % width + width) % width, row = (y % height + height) % height;
        return texels[static_cast<size_t>(row * width + column)];
    }
};

LinearImage readMip(const PlainImage& image, uint32_t mip)
{
    const MipExtent extent = mipExtent(image.record, mip);
    LinearImage linear{extent.width, extent.height};
    for (const DecodedTexel& texel : texels::decodeRows(image, mip, 0, extent.height))
        linear.texels.push_back({reference::linearFromSrgb(texel[0] / 65535.0),
                                 reference::linearFromSrgb(texel[1] / 65535.0),
                                 reference::linearFromSrgb(texel[2] / 65535.0)});
    return linear;
}

/// Weights of the 12 texels around the middle of a texel of half the size: a sinc under a Kaiser window of
/// three target texels to either side, with alpha 4.
std::array<double, 12> kaiserWeights()
{
    constexpr double kAlpha = 4, kRadius = 3;
    std::array<double, 12> weights{};
    double sum = 0;
    for (size_t i = 0; i < weights.size(); ++i)
    {
        const double t = (static_cast<double>(i) - 5.5) / 2;
        const double window = std::cyl_bessel_i(0.0, kAlpha * std::sqrt(1 - t * t / (kRadius * kRadius)));
        weights[i] = std::sin(std::numbers::pi * t) / (std::numbers::pi * t) * window;
        sum += weights[i];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

/// Halve an image in one direction, which repeats.
LinearImage halve(const LinearImage& image, bool across)
{
    static const std::array<double, 12> kWeights = kaiserWeights();
    LinearImage half{image.width / (across ? 2 : 1), image.height / (across ? 1 : 2)};
    for (uint32_t y = 0; y < half.height; ++y)
        for (uint32_t x = 0; x < half.width; ++x)
        {
            Color sum{};
            for (size_t i = 0; i < kWeights.size(); ++i)
            {
                const int64_t aside = static_cast<int64_t>(i) - 5;
                const Color& texel =
                    across ? image.at(int64_t{x} * 2 + aside, y) : image.at(x, int64_t{y} * 2 + aside);
                for (size_t c = 0; c < 3; ++c)
                    sum[c] += texel[c] * kWeights[i];
            }
            half.texels.push_back(sum);
        }
    return half;
}

/// Round a channel to what a texel of 8 bits holds.
double store(double linear)
{
    const double code = std::round(reference::srgbFromLinear(std::clamp(linear, 0.0, 1.0)) * 255);
    return reference::linearFromSrgb(code / 255);
}

/// Make all mips from the finest one. Each is made of the unrounded one before it.
std::vector<LinearImage> makeKaiserMips(const LinearImage& finest, uint32_t count)
{
    std::vector<LinearImage> mips{finest};
    LinearImage exact = finest;
    while (mips.size() < count)
    {
        exact = halve(halve(exact, true), false);
        LinearImage rounded = exact;
        for (Color& texel : rounded.texels)
            for (double& channel : texel)
                channel = store(channel);
        mips.push_back(std::move(rounded));
    }
    return mips;
}

Color sampleLinear(const LinearImage& image, double u, double v)
{
    const double x = u * image.width - 0.5, y = v * image.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    Color sum{};
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx)
        {
            const double weight = (dx == 0 ? left + 1 - x : x - left) * (dy == 0 ? top + 1 - y : y - top);
            const Color& texel = image.at(static_cast<int64_t>(left) + dx, static_cast<int64_t>(top) + dy);
            for (size_t c = 0; c < 3; ++c)
                sum[c] += texel[c] * weight;
        }
    return sum;
}

// A picture is six squares side by side, each a part of a wall at a distance of so many texels a pixel,
// turned a little so that pixels and texels do not line up.
constexpr std::array<double, 6> kTexelsAPixel{1.2, 1.5, 2, 2.8, 4, 6};
constexpr uint32_t kSide = 192;
constexpr uint32_t kPointsAcross = 12; ///< of a pixel, for the supersampled picture
constexpr double kTurn = 0.13;         ///< radians
constexpr uint32_t kMips = 4;

/// Return the place on the wall that a point of a square shows.
std::array<double, 2> findPlace(const LinearImage& finest, double scale, double x, double y)
{
    const double c = std::cos(kTurn), s = std::sin(kTurn);
    return {(c * x - s * y) * scale / finest.width, (s * x + c * y) * scale / finest.height};
}

template <typename Shade>
reference::Image drawPicture(const Shade& shade)
{
    reference::Image picture(kSide * static_cast<uint32_t>(kTexelsAPixel.size()), kSide);
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < picture.width; ++x)
        {
            const Color color = shade(kTexelsAPixel[x / kSide], x % kSide, y);
            for (size_t c = 0; c < 3; ++c)
                picture.at(x, y)[c] = static_cast<uint8_t>(
                    std::lround(reference::srgbFromLinear(std::clamp(color[c], 0.0, 1.0)) * 255));
        }
    return picture;
}

reference::Image drawSupersampled(const LinearImage& finest)
{
    return drawPicture(
        [&](double scale, uint32_t x, uint32_t y)
        {
            Color sum{};
            for (uint32_t j = 0; j < kPointsAcross; ++j)
                for (uint32_t i = 0; i < kPointsAcross; ++i)
                {
                    const auto [u, v] = findPlace(finest, scale, x + (i + 0.5) / kPointsAcross,
                                                  y + (j + 0.5) / kPointsAcross);
                    const Color color = sampleLinear(finest, u, v);
                    for (size_t c = 0; c < 3; ++c)
                        sum[c] += color[c] / (kPointsAcross * kPointsAcross);
                }
            return sum;
        });
}

/// Draw by trilinear filtering.
reference::Image drawMips(const std::vector<LinearImage>& mips)
{
    return drawPicture(
        [&](double scale, uint32_t x, uint32_t y)
        {
            const auto [u, v] = findPlace(mips[0], scale, x + 0.5, y + 0.5);
            const double level = std::log2(scale), fraction = level - std::floor(level);
            const auto mip = static_cast<size_t>(level);
            const Color fine = sampleLinear(mips[mip], u, v), coarse = sampleLinear(mips[mip + 1], u, v);
            Color mix{};
            for (size_t c = 0; c < 3; ++c)
                mix[c] = fine[c] * (1 - fraction) + coarse[c] * fraction;
            return mix;
        });
}

struct Sums
{
    uint32_t images = 0;
    double box = 0, kaiser = 0;
};

void measureImage(const PlainImage& image, const std::string& name, Sums& sums)
{
    std::vector<LinearImage> mips;
    for (uint32_t mip = 0; mip < kMips; ++mip)
        mips.push_back(readMip(image, mip));
    const reference::Image wanted = drawSupersampled(mips[0]);
    const double box = reference::flip(wanted, drawMips(mips)).mean();
    const double kaiser = reference::flip(wanted, drawMips(makeKaiserMips(mips[0], kMips))).mean();
    fmt::print("{:40.40} {:>8.4f} {:>8.4f} {:>+7.1f} %\n", name, box, kaiser, 100 * (kaiser / box - 1));
    std::fflush(stdout);
    ++sums.images;
    sums.box += box;
    sums.kaiser += kaiser;
}

/// Sides that halve exactly, and enough texels for the views.
bool suits(const ImageRecord& image)
{
    constexpr uint32_t kMinSide = 512;
    return std::has_single_bit(image.width) && std::has_single_bit(image.height) &&
           std::min(image.width, image.height) >= kMinSide && isSrgb(image.format) &&
           (image.flags & kImagePlaceholder) == 0;
}

Result<PackView> openPart(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
    return PackView::read(std::move(reader));
}

Status measureSource(const std::string& stem, Sums& sums)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView import_part, openPart(stem + ".import.part"));
    HEARTH_ASSIGN_OR_RETURN(const PackView part, openPart(stem + ".textures.part"));
    const std::span<const MaterialRecord> materials = findMaterials(import_part, part);
    const auto uses = imageUses(materials, findMaterialLayers(import_part, part), part.images().size());
    for (uint32_t i = 0; i < part.images().size(); ++i)
    {
        const ImageRecord& record = part.images()[i];
        const ImageRole role = texels::findReads(record, uses[i], materials).role;
        if (!suits(record) || (role != ImageRole::color && role != ImageRole::emissive))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, part.imageData(i));
        measureImage({.record = record, .mips = data.bytes(), .role = role, .channels = texels::kRgb},
                     fmt::format("{} {}", std::filesystem::path(stem).filename().string(), i), sums);
    }
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Compares mips of colours with supersampled pictures: ours, and a Kaiser filter's.");
    std::vector<std::string> stems;
    app.addOption("source", stems, "STEM of STEM.import.part and STEM.textures.part").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    fmt::print("mean FLIP beside {} points a pixel\n{:40} {:>8} {:>8}\n", kPointsAcross * kPointsAcross, "",
               "ours", "Kaiser");
    Sums sums;
    for (const std::string& stem : stems)
        if (const Status measured = measureSource(stem, sums); !measured.ok())
            return reportFailure(measured.error());
    if (sums.images == 0)
        return reportFailure(Error{Issue::usage, stems.front(), "", "no colours of 512 texels a side"});
    bench::Judgement judgement("mip-filters");
    fmt::print("{:40} {:>8.4f} {:>8.4f}\n", fmt::format("mean of {} images", sums.images),
               sums.box / sums.images, sums.kaiser / sums.images);
    judgement.record("mean FLIP / that of a Kaiser filter", sums.box / sums.kaiser);
    return judgement.finish();
}

} // namespace

int main(int argc, char** argv)
{
    return runProgram("hearth_measure_mip_filters", [&] { return program(argc, argv); });
}
