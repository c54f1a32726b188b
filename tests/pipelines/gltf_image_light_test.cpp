// Tests the image-based light of a scene (EXT_lights_image_based): directions, radiance, and refusals.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/source_space.h"
#include "tests/pipelines/gltf_fixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>

namespace hearth::import::test
{

namespace
{

using testing::HasSubstr;

constexpr uint32_t kSide = 4; ///< of the faces of most tests

using Code = std::array<uint8_t, 4>; ///< of a texel: red, green, blue, alpha

/// Return a TGA of the codes, rows from top to bottom.
std::string tga(uint16_t width, uint16_t height, const std::function<Code(uint32_t x, uint32_t y)>& code)
{
    std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
    bytes += toBytes<uint16_t>({width, height});
    bytes += std::string("\x20\x28", 2); // 32 bits, top to bottom, 8 bits of alpha
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
        {
            const Code c = code(x, y);
            bytes += toBytes<uint8_t>({c[2], c[1], c[0], c[3]});
        }
    return bytes;
}

/// Code that only one texel of all faces has.
Code markTexel(uint32_t face, uint32_t x, uint32_t y)
{
    return {static_cast<uint8_t>(40 + 30 * face), static_cast<uint8_t>(60 + 40 * x),
            static_cast<uint8_t>(60 + 40 * y), 255};
}

void writeFaces(const TemporaryFolder& folder, const std::function<Code(uint32_t, uint32_t, uint32_t)>& code)
{
    for (uint32_t face = 0; face < 6; ++face)
        folder.write(fmt::format("{}.tga", face),
                     tga(kSide, kSide, [&](uint32_t x, uint32_t y) { return code(face, x, y); }));
}

constexpr const char* kCoefficients =
    R"("irradianceCoefficients":[[1,1,1],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]])";

/// Members of a document whose scene has a light.
/// light  further members of the light, and a comma
std::string document(const std::string& light = "", const std::string& scene_light = R"("light":0)")
{
    return R"("extensionsRequired":["EXT_lights_image_based"],"images":[{"uri":"0.tga"},{"uri":"1.tga"},
        {"uri":"2.tga"},{"uri":"3.tga"},{"uri":"4.tga"},{"uri":"5.tga"}],
        "extensions":{"EXT_lights_image_based":{"lights":[{)" +
           light + kCoefficients + R"(,"specularImageSize":4,"specularImages":[[0,1,2,3,4,5]]}]}},
        "scenes":[{"extensions":{"EXT_lights_image_based":{)" +
           scene_light + "}}}]";
}

/// Return the linear light of a code of sRGB, as IEC 61966-2-1 defines it.
double decode(uint8_t code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Direction in which a face lies, and what is up in its image.
struct Axes
{
    Double3 forward, up;
};
constexpr std::array<Axes, 6> kFaceAxes{Axes{{1, 0, 0}, {0, 1, 0}},  Axes{{-1, 0, 0}, {0, 1, 0}},
                                        Axes{{0, 1, 0}, {0, 0, -1}}, Axes{{0, -1, 0}, {0, 0, 1}},
                                        Axes{{0, 0, 1}, {0, 1, 0}},  Axes{{0, 0, -1}, {0, 1, 0}}};

/// Return the direction of a texel in the picture that a camera in the cube takes of a face.
Double3 findDirection(uint32_t face, uint32_t x, uint32_t y)
{
    const auto [forward, up] = kFaceAxes[face];
    const Double3 right = cross(forward, up);
    return forward + right * ((2 * x + 1.0) / kSide - 1) + up * (1 - (2 * y + 1.0) / kSide);
}

class GltfImageLight : public testing::Test
{
protected:
    GltfImageLight() { writeFaces(folder_, markTexel); }

    Imported import(const std::string& members, const ImportOptions& options = {})
    {
        return GltfData().import(members, &folder_, options);
    }

    environment::Environment importSky(const std::string& members)
    {
        const Imported result = import(members);
        EXPECT_TRUE(result.ok()) << result.message();
        EXPECT_TRUE(result.sky.has_value());
        return result.sky ? turnSky(*result.sky) : environment::Environment{};
    }

    void expectRefused(const std::string& members, Issue issue, const std::string& where,
                       const std::string& text)
    {
        const Imported result = import(members);
        ASSERT_FALSE(result.ok()) << text;
        EXPECT_EQ(result.status.error().issue, issue) << result.message();
        EXPECT_THAT(result.status.error().where, HasSubstr(where));
        EXPECT_THAT(result.message(), HasSubstr(text));
    }

    TemporaryFolder folder_;
};

} // namespace

TEST_F(GltfImageLight, facesAreWhatACameraInTheCubeSees)
{
    const environment::Environment sky = importSky(document());
    ASSERT_EQ(sky.texels.size(), 6 * kSide * kSide);
    for (uint32_t face = 0; face < 6; ++face)
        for (uint32_t y = 0; y < kSide; ++y)
            for (uint32_t x = 0; x < kSide; ++x)
            {
                const Float3 radiance = sky.texels[findTexel(sky, findDirection(face, x, y))];
                const Code code = markTexel(face, x, y);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(radiance[c], decode(code[static_cast<size_t>(c)]), 1e-6)
                        << face << ' ' << x << ' ' << y;
            }
}

TEST_F(GltfImageLight, colorsAreDividedByAlpha)
{
    writeFaces(folder_,
               [](uint32_t face, uint32_t, uint32_t) {
                   return face == 2 ? Code{255, 128, 0, 51} : Code{0, 0, 0, 0};
               });
    const environment::Environment sky = importSky(document(R"("intensity":3,)"));
    const Float3 above = sky.texels[findTexel(sky, {0, 1, 0})];
    EXPECT_NEAR(above.x, 15, 1e-5) << "by an alpha of a fifth, three times as bright";
    EXPECT_NEAR(above.y, 15 * decode(128), 1e-5);
    EXPECT_EQ(above.z, 0);
    EXPECT_EQ(sky.texels[findTexel(sky, {1, 0, 0})], Float3{}) << "black under alpha 0";
}

TEST_F(GltfImageLight, turnsAsANodeWouldTurnIt)
{
    writeFaces(folder_,
               [](uint32_t face, uint32_t, uint32_t) {
                   return Code{static_cast<uint8_t>(40 * face), 9, 9, 255};
               });
    // a quarter turn about +Y takes +X to -Z and +Z to +X
    const environment::Environment sky = importSky(document(R"("rotation":[0,0.70710678,0,0.70710678],)"));
    const auto red = [&](Double3 direction) { return sky.texels[findTexel(sky, direction)].x; };
    EXPECT_NEAR(red({0, 0, -1}), decode(0), 1e-6);
    EXPECT_NEAR(red({0, 0, 1}), decode(40), 1e-6);
    EXPECT_NEAR(red({0, 1, 0}), decode(80), 1e-6);
    EXPECT_NEAR(red({0, -1, 0}), decode(120), 1e-6);
    EXPECT_NEAR(red({1, 0, 0}), decode(160), 1e-6);
    EXPECT_NEAR(red({-1, 0, 0}), decode(200), 1e-6);
}

TEST_F(GltfImageLight, turnsWithTheAxesOfItsSource)
{
    const Imported result = import(document(R"("rotation":[0,0.70710678,0,0.70710678],)"));
    ASSERT_TRUE(result.sky.has_value());
    auto part = PartBuilder::create(folder_.path("turned.part"), "test.glb");
    ASSERT_TRUE(part.ok());
    part->sky = result.sky;
    ASSERT_TRUE(convertToMetres({1, UpAxis::z}, *part).ok());
    // +X of the faces is -Z of the source, which becomes -Y where +Z is up
    const Double3 direction = transformVector(part->sky->world_from_cube, {1, 0, 0});
    EXPECT_LT(length(direction - Double3{0, -1, 0}), 1e-6);
}

TEST_F(GltfImageLight, blendsTexelsOfAnObliqueTurn)
{
    writeFaces(folder_,
               [](uint32_t face, uint32_t, uint32_t) {
                   return face == 0 ? Code{255, 255, 255, 255} : Code{0, 0, 0, 255};
               });
    // an eighth of a turn about +Y: the white face is centred between +X and -Z
    const environment::Environment sky = importSky(document(R"("rotation":[0,0.38268343,0,0.92387953],)"));
    EXPECT_EQ(sky.texels[findTexel(sky, {1, 0, -1})].x, 1);
    EXPECT_EQ(sky.texels[findTexel(sky, {-1, 0, 1})].x, 0);
    double white = 0;
    for (uint32_t face = 0; face < 6; ++face)
        for (uint32_t y = 0; y < kSide; ++y)
            for (uint32_t x = 0; x < kSide; ++x)
                white += double{sky.texels[sky.index(face, x, y)].x} *
                         panelSolidAngle(environment::Layout::cube, sky.area(x, y));
    EXPECT_NEAR(white, 4 * 3.14159265 / 6, 0.05) << "the face keeps its solid angle";
}

TEST_F(GltfImageLight, facesMayShareAnImage)
{
    const environment::Environment sky =
        importSky(replaced(document(), "[[0,1,2,3,4,5]]", "[[0,1,0,0,1,0]]"));
    for (const auto& [face, image] : {std::pair(0u, 0u), {1u, 1u}, {2u, 0u}, {3u, 0u}, {4u, 1u}, {5u, 0u}})
        EXPECT_NEAR(sky.texels[findTexel(sky, findDirection(face, 2, 1))].x,
                    decode(markTexel(image, 2, 1)[0]), 1e-6)
            << face;
}

TEST_F(GltfImageLight, imagesOfFacesAreInUse)
{
    const Imported result = import(document());
    EXPECT_FALSE(result.hasWarning(Issue::dropped, ""));
    EXPECT_TRUE(result.records<formats::ImageRecord>(formats::kChunkImages).empty()) << "no textures";
}

TEST_F(GltfImageLight, aSettingLeavesItOut)
{
    ImportOptions options;
    options.takes_sky = false;
    const Imported result = import(document(), options);
    EXPECT_TRUE(result.ok()) << result.message();
    EXPECT_FALSE(result.sky.has_value());
}

TEST_F(GltfImageLight, reportsALightThatIsNotKept)
{
    Imported result = import(replaced(document(R"("name":"noon",)"),
                                      R"([{"extensions":{"EXT_lights_image_based":{"light":0}}}])", "[{}]"));
    EXPECT_TRUE(result.ok()) << result.message();
    EXPECT_FALSE(result.sky.has_value());
    EXPECT_TRUE(result.hasWarning(Issue::dropped,
                                  "image-based light \"noon\", which the scene does not have, is not kept"));
    result = import(document(R"("intensity":0,)"));
    EXPECT_TRUE(result.ok()) << result.message();
    EXPECT_FALSE(result.sky.has_value());
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "image-based light 0, which is black, is not kept"));
}

TEST_F(GltfImageLight, refusesWrongProperties)
{
    const std::string light = "/extensions/EXT_lights_image_based/lights/0";
    const std::string images = R"("specularImages":[[0,1,2,3,4,5]])";
    const auto refuses =
        [&](const std::string& from, const std::string& to, Issue issue, const std::string& text)
    { expectRefused(replaced(document(), from, to), issue, light, text); };
    refuses(images, R"("specularImages":[[0,1,2,3,4]])", Issue::gltf_extension_value,
            "specularImages must be lists of 6 images, one list at least");
    refuses(images, R"("specularImages":[[0,1,2,3,4,5],[]])", Issue::gltf_extension_value,
            "specularImages must be lists of 6 images");
    refuses(images, R"("specularImages":[])", Issue::gltf_extension_value, "one list at least");
    refuses(images, R"("specularImages":[0,1,2,3,4,5])", Issue::gltf_structure, "must be an array");
    refuses(images, R"("specularImages":[[0,1,2,3,4,6]])", Issue::gltf_reference, "index 6 of 6");
    refuses("," + images, "", Issue::gltf_structure, "property \"specularImages\" is missing");
    refuses(R"("specularImageSize":4)", R"("specularImageSize":3)", Issue::gltf_extension_value,
            "specularImageSize must be a power of two, but is 3");
    refuses(R"("specularImageSize":4)", R"("specularImageSize":0)", Issue::gltf_value, "0");
    refuses(R"("specularImageSize":4,)", "", Issue::gltf_structure,
            "property \"specularImageSize\" is missing");
    refuses(kCoefficients, R"("irradianceCoefficients":[[1,1,1]])", Issue::gltf_extension_value,
            "irradianceCoefficients must be 9 lists of 3 numbers");
    refuses("[[1,1,1]", "[[1,1]", Issue::gltf_extension_value, "must be 9 lists of 3 numbers");
    refuses(std::string(kCoefficients) + ",", "", Issue::gltf_structure,
            "property \"irradianceCoefficients\" is missing");
    expectRefused(document(R"("rotation":[0,0,0,2],)"), Issue::gltf_extension_value, light + "/rotation",
                  "rotation must be a quaternion of length 1, but has 2");
    expectRefused(document(R"("rotation":[0,0,1],)"), Issue::gltf_structure, light + "/rotation",
                  "4 numbers");
    expectRefused(document(R"("intensity":-1,)"), Issue::gltf_extension_value, light + "/intensity",
                  "intensity must not be negative, but is -1");
    expectRefused(document(R"("intensity":1e99,)"), Issue::number_too_large, light + "/intensity", "1e+99");
    expectRefused(document("", R"("light":1)"), Issue::gltf_reference, "/scenes/0", "index 1 of 1");
    expectRefused(document("", ""), Issue::gltf_structure, "/scenes/0", "property \"light\" is missing");
}

TEST_F(GltfImageLight, refusesImagesThatAreNoFaces)
{
    const std::string where = "/extensions/EXT_lights_image_based/lights/0/specularImages/0/3";
    const auto plain = [](uint32_t, uint32_t) { return Code{255, 255, 255, 255}; };
    folder_.write("3.tga", tga(4, 2, plain));
    expectRefused(document(), Issue::gltf_extension_value, where,
                  "image \"3.tga\": has 4 x 2 texels, where specularImageSize is 4");
    folder_.write("3.tga", tga(8, 8, plain));
    expectRefused(document(), Issue::gltf_extension_value, where, "has 8 x 8 texels");
    folder_.write("3.tga", "no image");
    expectRefused(document(), Issue::image_malformed, where, "image \"3.tga\": ");
    folder_.write("3.tga", tga(4, 4, plain).substr(0, 40));
    expectRefused(document(), Issue::image_malformed, where, "image \"3.tga\": ");
    folder_.write("3.tga", tga(4, 4,
                               [](uint32_t x, uint32_t y) {
                                   return Code{1, 0, 0, static_cast<uint8_t>(x == 2 && y == 1 ? 0 : 255)};
                               }));
    expectRefused(document(), Issue::image_unsupported, where, "texel (2, 1) has a colour but alpha 0");
    expectRefused(replaced(document(), "3.tga", "none.tga"), Issue::input_missing, where,
                  "image \"none.tga\": ");
    folder_.write("3.tga", tga(4, 4, [](uint32_t, uint32_t) { return Code{255, 255, 255, 1}; }));
    expectRefused(document(R"("intensity":3e38,)"), Issue::number_too_large,
                  "/extensions/EXT_lights_image_based/lights/0", "intensity 3e+38");
}

} // namespace hearth::import::test
