// Measures the encoders of BC on images: error, speed on one core, and what slow exhaustive encoders leave to
// gain on a sample of blocks. `./dev bench bc` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/texels/bc/bc1.h"
#include "cook/texels/bc/bc4.h"
#include "cook/texels/bc/bc6h.h"
#include "cook/texels/bc/bc7.h"
#include "formats/base/half.h"
#include "formats/base/program.h"
#include "formats/base/regular_file.h"
#include "formats/texels/bc_decoder.h"
#include "pipelines/import/images/decode.h"
#include "tests/bench/aims.h"
#include "tests/bench/texels/bc_oracle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using namespace hearth::texels;

constexpr const char* kBench = "bc";
constexpr const char* kEffortNames[] = {"draft", "normal", "high"};

/// Blocks of an image.
struct Blocks
{
    std::vector<Block8> colors; ///< of images of 8 bits
    std::vector<Block16> light; ///< of float images
    bool has_alpha = false;
};

/// Outcome of an encoder.
struct Result8
{
    double psnr;
    double megatexels;            ///< a second of processor time
    std::vector<uint64_t> errors; ///< by block
};

double secondsOfProcessor()
{
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Cut an image into blocks, without the texels that fill none.
/// max_blocks  of a large image every nth is taken
Blocks cutBlocks(const import::DecodedImage& image, size_t max_blocks)
{
    Blocks blocks;
    const size_t columns = image.width / 4, count = columns * (image.height / 4);
    const size_t stride = (count + max_blocks - 1) / max_blocks;
    for (size_t i = 0; i < count; i += stride)
    {
        Block8 colors{};
        Block16 light{};
        for (size_t t = 0; t < 16; ++t)
        {
            const size_t x = i % columns * 4 + t % 4, y = i / columns * 4 + t / 4;
            const std::byte* texel = &image.texels[(y * image.width + x) * image.texelBytes()];
            if (image.channelBytes() == 1)
                std::memcpy(colors[t].data(), texel, 4);
            else
                std::memcpy(light[t].data(), texel, 8);
            blocks.has_alpha |= image.channelBytes() == 1 && colors[t][3] != 255;
        }
        if (image.isFloat())
            blocks.light.push_back(light);
        else
            blocks.colors.push_back(colors);
    }
    return blocks;
}

/// Encode all blocks, and sum up the errors that the encoder reports.
/// samples  values a block whose error counts
template <typename Block, typename Encode>
Result8 measure(const std::vector<Block>& blocks, size_t samples, double max, const Encode& encode)
{
    Result8 result{};
    std::array<std::byte, 16> bytes{};
    const double start = secondsOfProcessor();
    double sum = 0;
    for (const Block& block : blocks)
    {
        result.errors.push_back(encode(block, std::span(bytes)));
        sum += static_cast<double>(result.errors.back());
    }
    const double seconds = secondsOfProcessor() - start;
    const auto count = static_cast<double>(blocks.size());
    result.megatexels = count * 16 / seconds / 1e6;
    result.psnr = 10 * std::log10(max * max * count * static_cast<double>(samples) / sum);
    return result;
}

void print(const char* format, Effort effort, const Result8& result)
{
    std::printf("  %-4s %-6s %7.2f dB %7.3f Mtexel/s\n", format, kEffortNames[static_cast<size_t>(effort)],
                result.psnr, result.megatexels);
    std::fflush(stdout);
}

/// Return by how much more error, in dB, the encoder has than the oracle on a sample of the blocks that it
/// does not store exactly: the others, most of a painted image, have nothing to gain.
template <typename Oracle>
double lossToOracle(const Blocks& blocks, const Result8& result, size_t samples, const Oracle& oracle)
{
    std::vector<size_t> inexact;
    for (size_t i = 0; i < result.errors.size(); ++i)
        if (result.errors[i] > 0)
            inexact.push_back(i);
    samples = std::min(samples, inexact.size());
    double own = 0, least = 0;
    for (size_t i = 0; i < samples; ++i)
    {
        const size_t at = inexact[(2 * i + 1) * inexact.size() / (2 * samples)];
        own += static_cast<double>(result.errors[at]);
        // what the encoder found is possible, too
        least += static_cast<double>(std::min(oracle(blocks.colors[at]), result.errors[at]));
    }
    return own == 0 ? 0 : 10 * std::log10(own / least);
}

Block16 widen(const Block8& block)
{
    Block16 wide;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 4; ++c)
            wide[t][c] = static_cast<uint16_t>(block[t][c] * 257);
    return wide;
}

struct Sample
{
    size_t bc1; ///< blocks for the oracle
    size_t bc7;
};

void measureColors(const Blocks& blocks, const Sample& sample, bench::Judgement& judgement)
{
    const ChannelWeights rgb = {1, 1, 1, 0};
    const ChannelWeights all = {1, 1, 1, static_cast<uint8_t>(blocks.has_alpha ? 1 : 0)};
    const size_t channels = blocks.has_alpha ? 4 : 3;
    for (const Effort effort : {Effort::draft, Effort::normal, Effort::high})
    {
        const bool judged = effort == Effort::normal;
        const Result8 bc1 =
            measure(blocks.colors, 48, 255,
                    [&](const Block8& block, std::span<std::byte, 16> bytes)
                    { return encodeBc1(block, rgb, Bc1Palettes::all, effort, bytes.first<8>()); });
        print("BC1", effort, bc1);
        const double bc1_loss = lossToOracle(blocks, bc1, sample.bc1, bench::oracleBc1);
        std::printf("       %.3f dB less than exhaustive, %zu blocks\n", bc1_loss, sample.bc1);
        print("BC4", effort,
              measure(blocks.colors, 16, 65535,
                      [&](const Block8& block, std::span<std::byte, 16> bytes)
                      { return encodeBc4(widen(block), 0, effort, bytes.first<8>()); }));
        const Result8 bc7 = measure(blocks.colors, 16 * channels, 255,
                                    [&](const Block8& block, std::span<std::byte, 16> bytes)
                                    { return encodeBc7(block, all, effort, bytes); });
        print("BC7", effort, bc7);
        if (!judged)
            continue;
        const double bc7_loss =
            lossToOracle(blocks, bc7, sample.bc7,
                         [&](const Block8& block) { return bench::oracleBc7(block, blocks.has_alpha); });
        std::printf("       %.3f dB less than exhaustive, %zu blocks\n", bc7_loss, sample.bc7);
        judgement.record("BC1, dB less than exhaustive", bc1_loss);
        judgement.record("BC1, Mtexel/s", bc1.megatexels);
        judgement.record("BC7, dB less than exhaustive", bc7_loss);
        judgement.record("BC7, Mtexel/s", bc7.megatexels);
    }
}

/// Print the error of BC6H also as the role of light counts it.
void measureLight(const Blocks& blocks)
{
    for (const Effort effort : {Effort::draft, Effort::normal, Effort::high})
    {
        double squares = 0;
        const Result8 result = measure(blocks.light, 48, 0x7BFF,
                                       [&](const Block16& block, std::span<std::byte, 16> bytes)
                                       { return encodeBc6h(block, effort, bytes); });
        for (const Block16& block : blocks.light)
        {
            std::array<std::byte, 16> bytes;
            encodeBc6h(block, effort, bytes);
            std::array<DecodedTexel, 16> decoded;
            decodeBcBlock(texelTraits(TexelFormat::bc6h_ufloat), bytes, decoded);
            const auto logarithm = [](uint16_t half)
            { return std::log2(1 + std::clamp(double{floatFromHalf(half)}, 0.0, double{kHalfMax})); };
            for (size_t t = 0; t < 16; ++t)
                for (size_t c = 0; c < 3; ++c)
                {
                    const double d = logarithm(decoded[t][c]) - logarithm(block[t][c]);
                    squares += std::isnan(d) ? 0 : d * d;
                }
        }
        print("BC6H", effort, result);
        std::printf("       rms of log2(1 + v): %.5f\n",
                    std::sqrt(squares / static_cast<double>(blocks.light.size() * 48)));
    }
}

Status measureImage(const std::string& path, size_t max_blocks, const Sample& sample,
                    bench::Judgement& judgement)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string bytes, readFile(path));
    HEARTH_ASSIGN_OR_RETURN(const import::DecodedImage image,
                            import::decodeImage(std::as_bytes(std::span(bytes)), path, {}));
    const Blocks blocks = cutBlocks(image, max_blocks);
    std::printf("%s: %u x %u\n", path.c_str(), image.width, image.height);
    if (!blocks.light.empty())
        measureLight(blocks);
    if (!blocks.colors.empty())
        measureColors(blocks, sample, judgement);
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures the encoders of BC on images.");
    std::vector<std::string> images;
    uint32_t max_blocks = 16384, bc7_sample = 700;
    app.addOption("IMAGE", images, "images of 8 bits a channel or of floats").required();
    app.addOption("--blocks", max_blocks, "blocks of an image, at most").showDefault();
    app.addOption("--sample", bc7_sample, "of those, blocks of which BC7's best is searched for")
        .showDefault();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    bench::Judgement judgement(kBench);
    for (const std::string& image : images)
        if (const Status measured =
                measureImage(image, max_blocks, {2 * size_t{bc7_sample}, bc7_sample}, judgement);
            !measured.ok())
            return reportFailure(measured.error());
    std::printf(
        "Peers on other textures, beside: rgbcx 18 has 40.5 to 41.2 dB at .4 to .7 Mtexel/s, bc7e at level "
        "4 49.1 to 54.1 dB at 1.07\n");
    return judgement.finish();
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_bc", [&] { return program(argc, argv); });
}
