// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_texture.h"

#include "formats/base/atomic_file.h"
#include "formats/base/nearest_match.h"
#include "formats/pack/decode_image.h"
#include "formats/texels/plain_encoder.h"
#include "formats/texels/swizzle.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/texture_files/ktx2_writer.h"

#include <charconv>

namespace hearth::command
{

using namespace formats;

namespace
{

/// Return the index of the image with a name, or with a number as its name.
Result<uint32_t> findImage(const PackView& pack, const std::string& path, const std::string& name)
{
    std::vector<std::string> names;
    for (uint32_t i = 0; i < pack.images().size(); ++i)
    {
        names.emplace_back(pack.text(pack.images()[i].name));
        if (names.back() == name)
            return i;
    }
    uint32_t index = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (fault == std::errc() && end == name.data() + name.size() && index < names.size())
        return index;
    const std::string nearest = nearestMatch(name, names);
    return Error{
        Issue::usage, path, "--texture",
        "there is no texture \"" + name + "\"" +
            (nearest.empty() ? ": hearth inspect lists them" : "; did you mean \"" + nearest + "\"?")};
}

/// Return all mips in a format of RGBA8, as shaders read them.
std::vector<std::byte> decodeMips(const ImageRecord& image, std::span<const std::byte> mips,
                                  const TexelFormatTraits& traits)
{
    std::vector<std::byte> bytes;
    for (uint32_t mip = 0; mip < image.mip_count; ++mip)
    {
        std::vector<DecodedTexel> texels = decodeImageMip(image, mips, mip);
        for (DecodedTexel& texel : texels)
            texel = applySwizzle(texel, image.swizzle, 0xFFFF);
        const size_t before = bytes.size();
        bytes.resize(before + texels.size() * traits.block_bytes);
        encodePlain(traits, texels, std::span(bytes).subspan(before));
    }
    return bytes;
}

} // namespace

std::string swizzleText(const ImageRecord& image)
{
    constexpr std::string_view kSources = "?01rgba";
    std::string text = "rgba";
    for (size_t c = 0; c < text.size(); ++c)
        if (image.swizzle[c] != static_cast<uint8_t>(Swizzle::identity))
            text[c] = kSources[image.swizzle[c]];
    return text;
}

Status extractTexture(const std::string& path, const TextureExtraction& extraction, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, openContainer(path));
    HEARTH_ASSIGN_OR_RETURN(const uint32_t index, findImage(pack, path, extraction.texture));
    const ImageRecord& image = pack.images()[index];
    const TexelFormatTraits& stored = *findTexelFormat(image.format);
    if (extraction.is_decoded && stored.coding == TexelCoding::float_value)
        return Error{Issue::usage, path, "--as",
                     "the texture has floats, which RGBA8 cannot hold: leave --as out"};
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, pack.imageData(index));

    const TexelFormat plain =
        stored.coding == TexelCoding::srgb ? TexelFormat::rgba8_srgb : TexelFormat::rgba8_unorm;
    std::vector<std::byte> decoded;
    texture_files::Texture texture{&stored,         image.width,  image.height,
                                   image.mip_count, data.bytes(), swizzleText(image)};
    if (extraction.is_decoded)
    {
        texture.traits = &texelTraits(plain);
        decoded = decodeMips(image, data.bytes(), *texture.traits);
        texture.mips = decoded;
        texture.swizzle = "rgba";
    }
    const std::vector<std::byte> file =
        texture_files::writeKtx2(texture, "hearth " HEARTH_VERSION, extraction.is_compressed);
    HEARTH_ASSIGN_OR_RETURN(AtomicFile ktx2, AtomicFile::create(output));
    ktx2.write(std::string_view(reinterpret_cast<const char*>(file.data()), file.size()));
    return ktx2.finish();
}

} // namespace hearth::command
