// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/environments/read_environment.h"

#include "formats/base/regular_file.h"
#include "pipelines/import/images/float_image.h"

#include <array>
#include <cmath>
#include <string_view>

namespace hearth::environments
{

namespace
{

using environment::Environment;
using environment::Layout;
using import::EncodedImage;
using import::FloatImage;

struct Signature
{
    std::string_view bytes;
    Result<FloatImage> (*decode)(const EncodedImage&);
};

constexpr std::array kSignatures = {
    Signature{"#?RADIANCE", import::decodeHdrFloats},
    Signature{"#?RGBE", import::decodeHdrFloats},
    Signature{"\x76\x2F\x31\x01", import::decodeExrFloats},
    Signature{"\xABKTX 20\xBB\r\n\x1A\n", import::decodeKtx2Floats},
};

Result<FloatImage> decode(const EncodedImage& source)
{
    const std::string_view text(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
    for (const Signature& signature : kSignatures)
        if (text.starts_with(signature.bytes))
            return signature.decode(source);
    return source.unsupported("an environment is an image of format HDR, EXR or KTX2");
}

/// Return "texel (3, 5)", of a cube "texel (3, 5) of face 2".
std::string nameTexel(const FloatImage& image, size_t index)
{
    const size_t row = index / image.width;
    const std::string name =
        "texel (" + std::to_string(index % image.width) + ", " + std::to_string(row % image.height) + ")";
    return image.faces == 1 ? name : name + " of face " + std::to_string(row / image.height);
}

/// Make radiance of what the file holds.
Status cleanTexels(const EncodedImage& source, FloatImage& image)
{
    for (size_t i = 0; i < image.texels.size(); ++i)
        for (int c = 0; c < 3; ++c)
        {
            float& value = image.texels[i][c];
            if (!std::isfinite(value))
                return source.malformed(nameTexel(image, i) + " is " +
                                        (std::isnan(value) ? "not a number" : "infinite"));
            value = std::max(value, 0.0f);
        }
    return success();
}

} // namespace

Result<Environment> decodeEnvironment(std::span<const std::byte> bytes, const std::string& name)
{
    const import::ImportLimits limits;
    const EncodedImage source{bytes, name, limits};
    HEARTH_ASSIGN_OR_RETURN(FloatImage image, decode(source));
    const bool is_cube = image.faces == 6;
    if (!is_cube && image.width != uint64_t{2} * image.height)
        return source.unsupported("an environment is twice as wide as high, or a cube; this image is " +
                                  std::to_string(image.width) + " x " + std::to_string(image.height) +
                                  " texels");
    HEARTH_TRY(cleanTexels(source, image));
    return Environment{is_cube ? Layout::cube : Layout::lat_long, image.width, image.height,
                       std::move(image.texels)};
}

Result<Environment> readEnvironment(const std::string& path)
{
    const import::ImportLimits limits;
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(path, limits.max_file_bytes));
    return decodeEnvironment(std::as_bytes(std::span(text)), path);
}

} // namespace hearth::environments
