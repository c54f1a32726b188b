// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/command/sky_source.h"

#include "tests/support/small_sources.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr uint32_t kSide = kSkySourceSide;

uint8_t encodeSrgb(double linear)
{
    const double code = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255 * code));
}

/// Return the picture that a camera takes of a sky, in RGBD, as a TGA.
std::string photograph(const Sky& sky, Double3 forward, Double3 up)
{
    std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
    bytes += {static_cast<char>(kSide), 0, static_cast<char>(kSide), 0, 32, 0x28};
    const Double3 right = cross(forward, up);
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x)
        {
            const Double3 color =
                sky(forward + right * ((2 * x + 1.0) / kSide - 1) + up * (1 - (2 * y + 1.0) / kSide));
            const double d = std::floor(std::min(1.0, 1 / std::max({color.x, color.y, color.z})) * 255) / 255;
            for (const double channel : {color.z, color.y, color.x})
                bytes += static_cast<char>(encodeSrgb(channel * d));
            bytes += static_cast<char>(std::lround(255 * d));
        }
    return bytes;
}

} // namespace

void writeGltfUnderSky(const Sandbox& folder, const std::string& name, const Sky& sky)
{
    writeGltf(folder, name);
    folder.write(name + ".tga", tgaImage(128));
    constexpr std::array<std::array<Double3, 2>, 6> kFaces{{{{{1, 0, 0}, {0, 1, 0}}},
                                                            {{{-1, 0, 0}, {0, 1, 0}}},
                                                            {{{0, 1, 0}, {0, 0, -1}}},
                                                            {{{0, -1, 0}, {0, 0, 1}}},
                                                            {{{0, 0, 1}, {0, 1, 0}}},
                                                            {{{0, 0, -1}, {0, 1, 0}}}}};
    std::string images, faces;
    for (size_t face = 0; face < kFaces.size(); ++face)
    {
        const std::string file = name + std::to_string(face) + ".tga";
        folder.write(file, photograph(sky, kFaces[face][0], kFaces[face][1]));
        images += R"(,{"uri":")" + file + R"("})";
        faces += (face == 0 ? "" : ",") + std::to_string(face + 1);
    }
    std::string text = folder.read(name + ".gltf");
    const auto insertAfter = [&](const std::string& place, const std::string& addition)
    { text.insert(text.find(place) + place.size(), addition); };
    insertAfter(R"("nodes":[0])", R"(,"extensions":{"EXT_lights_image_based":{"light":0}})");
    insertAfter(name + R"(.tga"})", images);
    insertAfter(
        R"("scene":0,)",
        R"("extensionsUsed":["EXT_lights_image_based"],"extensions":{"EXT_lights_image_based":{"lights":)"
        R"([{"specularImageSize":16,"specularImages":[[)" +
            faces +
            R"(]],"irradianceCoefficients":[[1,1,1],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],)"
            R"([0,0,0],[0,0,0]]}]}},)");
    folder.write(name + ".gltf", text);
}

} // namespace hearth::test
