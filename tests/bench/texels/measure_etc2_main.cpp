// Measures the encoders of ETC2 and EAC on images: decibels beside those of exhaustive encoders, and speed on
// one core. `./dev bench etc2` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/texels/etc2/eac_encoder.h"
#include "cook/texels/etc2/etc2_encoder.h"
#include "formats/base/program.h"
#include "formats/base/regular_file.h"
#include "formats/texels/etc2_decoder.h"
#include "pipelines/import/images/decode.h"
#include "tests/bench/aims.h"
#include "tests/bench/texels/slow_etc2.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>

namespace
{

using namespace hearth;
using namespace hearth::texels;

double processorSeconds()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Cut an image of 8 bits into blocks, without the texels at its end that fill no block. Alpha becomes that
/// of the image, or a copy of green if that is opaque.
std::vector<Block8> cutBlocks(const import::DecodedImage& image)
{
    std::vector<Block8> blocks;
    bool is_opaque = true;
    for (uint32_t y = 0; y + 4 <= image.height; y += 4)
        for (uint32_t x = 0; x + 4 <= image.width; x += 4)
        {
            Block8& block = blocks.emplace_back();
            for (uint32_t t = 0; t < 16; ++t)
                for (size_t c = 0; c < 4; ++c)
                {
                    const size_t texel = size_t{y + t / 4} * image.width + x + t % 4;
                    block[t][c] = std::to_integer<uint8_t>(image.texels[4 * texel + c]);
                    is_opaque = is_opaque && (c < 3 || block[t][c] == 255);
                }
        }
    for (Block8& block : blocks)
        for (auto& texel : block)
            texel[3] = is_opaque ? texel[1] : texel[3];
    return blocks;
}

/// Bytes of an encoded block and the error that the encoder states.
struct Encoded
{
    std::vector<std::byte> bytes;
    uint64_t error;
};

template <typename Bytes>
Encoded makeEncoded(const Bytes& bytes, uint64_t error)
{
    return {{bytes.begin(), bytes.end()}, error};
}

/// Encoder of some channels, and its oracle.
struct Method
{
    std::string name; ///< as in the aims
    formats::TexelFormat format;
    size_t first_channel;
    size_t channels;
    uint64_t code; ///< codes of 16 bits in a code of the error
    std::function<Encoded(const Block8&, Effort)> encode;
    std::function<uint64_t(const Block8&)> least_error;
};

/// Return a channel as unorm of 16 bits.
std::array<uint16_t, 16> widenChannel(const Block8& block, size_t channel)
{
    std::array<uint16_t, 16> codes;
    for (size_t t = 0; t < 16; ++t)
        codes[t] = static_cast<uint16_t>(block[t][channel] * 257);
    return codes;
}

std::array<uint8_t, 16> gatherAlpha(const Block8& block)
{
    std::array<uint8_t, 16> alphas;
    for (size_t t = 0; t < 16; ++t)
        alphas[t] = block[t][3];
    return alphas;
}

Encoded encodeColors(const Block8& block, Effort effort)
{
    static const std::array<Etc2Encoder, 3> encoders{Etc2Encoder(Effort::draft), Etc2Encoder(Effort::normal),
                                                     Etc2Encoder(Effort::high)};
    const EncodedColors encoded = encoders[static_cast<size_t>(effort)].encodeRgb(block);
    return makeEncoded(encoded.bytes, encoded.error);
}

Encoded encodeRedGreen(const Block8& block, Effort effort)
{
    const std::array<uint16_t, 16> red = widenChannel(block, 0), green = widenChannel(block, 1);
    Block16 wide;
    for (size_t t = 0; t < 16; ++t)
        wide[t] = {red[t], green[t], 0, 0};
    const EncodedRg11 encoded = encodeEacRg11(wide, effort);
    return makeEncoded(encoded.bytes, encoded.error);
}

Encoded encodeAlpha(const Block8& block, Effort effort)
{
    const EncodedAlpha encoded = encodeEacAlpha(gatherAlpha(block), effort);
    Encoded result = makeEncoded(encoded.bytes, encoded.error);
    result.bytes.resize(16); // colours of any kind
    return result;
}

std::vector<Method> listMethods()
{
    using formats::TexelFormat;
    return {{"RGB8", TexelFormat::etc2_rgb8_unorm, 0, 3, 257, encodeColors, bench::leastColorError},
            {"RG11", TexelFormat::eac_rg11_unorm, 0, 2, 1, encodeRedGreen,
             [](const Block8& block) {
                 return bench::leastR11Error(widenChannel(block, 0)) +
                        bench::leastR11Error(widenChannel(block, 1));
             }},
            {"alpha", TexelFormat::etc2_rgba8_unorm, 3, 1, 257, encodeAlpha,
             [](const Block8& block) { return bench::leastAlphaError(gatherAlpha(block)); }}};
}

/// Return the sum of squares of a decoded block, in codes of 16 bits.
uint64_t recount(const Method& method, const Block8& block, std::span<const std::byte> bytes)
{
    std::array<formats::DecodedTexel, 16> decoded;
    formats::decodeEtc2Block(formats::texelTraits(method.format), bytes, decoded);
    uint64_t sum = 0;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = method.first_channel; c < method.first_channel + method.channels; ++c)
        {
            const int64_t difference = int64_t{decoded[t][c]} - 257 * block[t][c];
            sum += static_cast<uint64_t>(difference * difference);
        }
    return sum;
}

/// Return the ratio of peak to noise of blocks with a sum of squares in codes of 16 bits.
double decibels(uint64_t squares, size_t blocks, const Method& method)
{
    const auto values = static_cast<double>(16 * blocks * method.channels);
    return 10 * std::log10(65535.0 * 65535.0 * values / std::max(static_cast<double>(squares), 1.0));
}

/// Sums of squares in codes of 16 bits, and speed.
struct Figures
{
    uint64_t squares = 0;
    uint64_t sample_squares = 0;
    double megatexels_second = 0;
    bool is_stated = true; ///< all errors are those that the encoder states
};

/// Encode all blocks.
/// step  every such block is in the sample
Figures measure(const Method& method, std::span<const Block8> blocks, size_t step, Effort effort)
{
    std::vector<Encoded> encoded;
    encoded.reserve(blocks.size());
    const double begin = processorSeconds();
    for (const Block8& block : blocks)
        encoded.push_back(method.encode(block, effort));
    Figures figures;
    figures.megatexels_second = static_cast<double>(blocks.size()) * 16e-6 / (processorSeconds() - begin);
    for (size_t b = 0; b < blocks.size(); ++b)
    {
        const uint64_t squares = recount(method, blocks[b], encoded[b].bytes);
        figures.is_stated = figures.is_stated && squares == method.code * method.code * encoded[b].error;
        figures.squares += squares;
        if (b % step == step / 2)
            figures.sample_squares += squares;
    }
    return figures;
}

/// Measure a method on an image.
/// returns  false if an encoder stated another error than that of its block
bool measureImage(const Method& method, std::span<const Block8> blocks, size_t samples,
                  bench::Judgement& judgement)
{
    // an odd step meets all columns
    const size_t step = std::max<size_t>(blocks.size() / samples, 1) | 1;
    uint64_t least = 0;
    size_t count = 0;
    for (size_t b = step / 2; b < blocks.size(); b += step, ++count)
        least += method.code * method.code * method.least_error(blocks[b]);
    const double oracle = decibels(least, count, method);
    bool is_stated = true;
    for (const auto& [effort, name] :
         {std::pair(Effort::draft, "draft"), {Effort::normal, "normal"}, {Effort::high, "high"}})
    {
        const Figures figures = measure(method, blocks, step, effort);
        const double sample = decibels(figures.sample_squares, count, method);
        std::printf("  %-5s %-6s %6.2f dB; of %zu blocks %6.2f, exhaustive %6.2f; %6.2f Mtexel/s\n",
                    method.name.c_str(), name, decibels(figures.squares, blocks.size(), method), count,
                    sample, oracle, figures.megatexels_second);
        is_stated = is_stated && figures.is_stated;
        if (effort == Effort::high)
            continue;
        const bool is_normal = effort == Effort::normal;
        const auto record = [&](const std::string& figure, double value)
        {
            for (const bench::Aim& aim : bench::kAims)
                if (aim.bench == "etc2" && aim.figure == figure)
                    judgement.record(aim.figure, value);
        };
        record("Mtexel/s of a core, " + std::string(name) + ": " + method.name, figures.megatexels_second);
        if (is_normal)
            record("dB below exhaustive search: " + method.name, oracle - sample);
    }
    return is_stated;
}

/// Measure the methods whose channels an image uses.
/// is_normal_map  RG11 alone
/// returns        exit code of a failure; 0 otherwise
int measureFile(const std::string& file, bool is_normal_map, size_t samples, bench::Judgement& judgement)
{
    const auto bytes = RegularFile(file).readText();
    if (!bytes)
        return reportFailure(bytes.error());
    const auto image = import::decodeImage(std::as_bytes(std::span(bytes.value())), file, {});
    if (!image)
        return reportFailure(image.error());
    if (image->type != import::ChannelType::unorm8)
    {
        std::fprintf(stderr, "error: %s: not an image of 8 bits\n", file.c_str());
        return 65;
    }
    std::printf("%s, %u x %u\n", file.substr(file.rfind('/') + 1).c_str(), image->width, image->height);
    const std::vector<Block8> blocks = cutBlocks(*image);
    for (const Method& method : listMethods())
    {
        if (is_normal_map != (method.channels == 2))
            continue;
        if (!measureImage(method, blocks, samples, judgement))
        {
            std::fprintf(stderr, "error: %s: a block has not the error stated\n", method.name.c_str());
            return 1;
        }
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app("Measures the encoders of ETC2 and EAC on images of 8 bits.");
    std::vector<std::string> files, normal_maps;
    uint32_t samples = 100;
    app.addOption("--colors", files, "images for RGB8 and alpha").required();
    app.addOption("--normals", normal_maps, "images for RG11").required();
    app.addOption("--samples", samples, "blocks of an image that are also encoded by exhaustion");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;

    bench::Judgement judgement("etc2");
    std::puts("anchor: etc2comp, effort 40: 41.5 and 40.5 dB at 0.05 Mtexel/s a core");
    const size_t count = std::max(samples, 1u);
    for (const std::string& file : files)
        if (const int exit_code = measureFile(file, false, count, judgement))
            return exit_code;
    for (const std::string& file : normal_maps)
        if (const int exit_code = measureFile(file, true, count, judgement))
            return exit_code;
    return judgement.finish();
}
