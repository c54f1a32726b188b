// Tests material functions of a game (hearth_add_material_shaders): a material whose function takes its
// values from its extras draws the image of a material that has these values, by every light method that has
// modules of its own, and by every way through a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/material_pack.h"

#include <algorithm>
#include <cmath>
#include <hearth_test_functions_material_shaders.h>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;

constexpr uint32_t kRed = 0xFF0000FF;

} // namespace

class CMaterialTest : public CApiTest
{
protected:
    /// Replace the renderer by one with these functions.
    void recreate(const hearth_material_shaders* shaders, uint32_t features = 0,
                  uint32_t way = HEARTH_FRAME_MERGED)
    {
        hearth_renderer_description description = c_caller_description(caller_);
        description.material_shaders = shaders;
        description.features = features;
        description.frame_way = way;
        recreateRenderer(description);
    }

    std::vector<uint32_t> draw(const MaterialPack& pack, const hearth_frame& frame = makeFrame(),
                               uint32_t targets_flags = 0, bool shadows = false)
    {
        std::vector<uint32_t> color(kWidth * kHeight), visibility(kWidth * kHeight);
        c_image image{};
        image.scene = HEARTH_SCENE_OPTIONS_INIT;
        image.scene.shadows.max_maps = shadows ? 8 : 0;
        image.scene.shadows.texels = 256;
        image.frame = frame;
        image.width = kWidth;
        image.height = kHeight;
        image.targets_flags = targets_flags;
        image.color = color.data();
        image.visibility = visibility.data();
        result_ = c_caller_draw(caller_, renderer_, pack.get(), &image);
        return color;
    }

    hearth_result result_ = HEARTH_OK;
};

TEST_F(CMaterialTest, drawsTheImageOfAMaterialWithTheSameValues)
{
    formats::MaterialRecord factors = doubleSided(plainMaterial());
    factors.base_color = {0.75f, 0.25f, 0.5f, 1};
    factors.metallic = 0.5f;
    factors.roughness = 0.375f;
    factors.emissive = {0.125f, 0.25f, 0.0625f};
    const MaterialPack expected(factors, "");
    const MaterialPack pack(doubleSided(plainMaterial()),
                            R"({"sound":"stone","hearth_material":"values_of_parameters",)"
                            R"("hearth_parameters":[0.75, 0.25, 5e-1, 0.5, 0.125,0.125,0.0625,0.375]})");
    constexpr std::pair<uint32_t, uint32_t> kMethods[] = {
        {HEARTH_LIGHTS_PRACTICAL, 0},
        {HEARTH_LIGHTS_DEFERRED, HEARTH_TARGETS_DEFERRED},
        {HEARTH_LIGHTS_PREPASS, HEARTH_TARGETS_PREPASS},
        {HEARTH_LIGHTS_CLASSIC_PREPASS, HEARTH_TARGETS_CLASSIC_PREPASS},
        {HEARTH_LIGHTS_ENCODED_PREPASS, HEARTH_TARGETS_ENCODED_PREPASS},
        {HEARTH_LIGHTS_STACK, HEARTH_TARGETS_STACK}};
    for (const uint32_t way : {HEARTH_FRAME_MERGED, HEARTH_FRAME_SEPARATE, HEARTH_FRAME_ONE_SET})
    {
        recreate(&hearth_test_functions_material_shaders, HEARTH_FEATURE_DEFERRED, way);
        for (const auto& [method, flags] : kMethods)
        {
            const bool shadows = way != HEARTH_FRAME_MERGED;
            hearth_frame frame = makeFrame();
            frame.light_method = method;
            const std::vector<uint32_t> plain = draw(expected, frame, flags, shadows);
            frame.material_inputs[1] = 0.125f; // the function adds it to the emission of its parameters
            EXPECT_EQ(draw(pack, frame, flags, shadows), plain) << method << " " << way;
            ASSERT_EQ(result_, HEARTH_OK) << hearth_last_error(renderer_);
            frame.material_inputs[1] = 0;
            EXPECT_NE(draw(pack, frame, flags, shadows), plain) << method;
            if (way != HEARTH_FRAME_MERGED) // the shaders are the same, but for the visibility buffer's place
                break;
        }
    }
}

TEST_F(CMaterialTest, functionsKnowThePlaceInTheWorld)
{
    recreate(&hearth_test_functions_material_shaders);
    const MaterialPack pack(unlit(),
                            R"({"hearth_material":"stripes","hearth_parameters":[0.5,0.25,-0.375]})");
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0; // the triangles that rays meet
    const std::vector<uint32_t> color = draw(pack, frame);
    ASSERT_EQ(result_, HEARTH_OK) << hearth_last_error(renderer_);
    hearth_queries* queries = nullptr;
    const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
    ASSERT_EQ(hearth_queries_create(pack.get(), &options, &queries, nullptr, 0), HEARTH_OK);
    size_t red = 0, others = 0, different = 0;
    for (uint32_t i = 0; i < color.size(); ++i)
    {
        hearth_ray ray{};
        hearth_hit hit{};
        ASSERT_EQ(hearth_frame_get_ray(&frame, kWidth, kHeight, static_cast<float>(i % kWidth) + 0.5f,
                                       static_cast<float>(i / kWidth) + 0.5f, &ray, nullptr, 0),
                  HEARTH_OK);
        ASSERT_EQ(hearth_queries_cast_rays(queries, &ray, 1, nullptr, &hit, nullptr, 0), HEARTH_OK);
        if (hit.instance == UINT32_MAX)
            continue;
        const double phase = 0.5 * hit.position[0] + 0.25 * hit.position[1] - 0.375 * hit.position[2];
        const double stripe = phase - std::floor(phase);
        if (std::min({stripe, std::abs(stripe - 0.5), 1 - stripe}) < 0.02)
            continue;
        const uint32_t other = hit.instance == 0 ? 0xFFFFFFFF : 0xFFFF0000; // the vertices' white and blue
        different += color[i] != (stripe < 0.5 ? kRed : other) ? 1 : 0;     // at edges, which devices round
        ++(stripe < 0.5 ? red : others);
    }
    EXPECT_LE(different, 4u);
    EXPECT_GT(red, 1000u);
    EXPECT_GT(others, 1000u);
    EXPECT_EQ(hearth_queries_destroy(queries), HEARTH_OK);
}

TEST_F(CMaterialTest, functionsSampleTheTexturesOfTheMaterial)
{
    recreate(&hearth_test_functions_material_shaders);
    const auto withTexture = [](const float(&transform)[6])
    {
        return [&transform](TestScene& scene, formats::MaterialRecord& material)
        {
            std::vector<uint32_t> texels;
            for (uint32_t size = 64; size > 0; size /= 2)
                for (uint32_t i = 0; i < size * size; ++i)
                    texels.push_back(0xFF000000u | i * 40503u);
            material.base_color_texture =
                makeTextureRef(scene.addImage(formats::TexelFormat::rgba8_srgb, 64, 64, texels));
            std::copy_n(transform, 6, material.base_color_texture.uv_transform);
        };
    };
    constexpr float kSmaller[6] = {4, 0, 0.25f, 0, 2, 0.5f}, kSame[6] = {1, 0, 0, 0, 1, 0};
    const MaterialPack expected(unlit(), "", withTexture(kSmaller));
    const MaterialPack pack(unlit(),
                            R"({"hearth_material":"smaller_texture","hearth_parameters":[4,2,0.25,0.5]})",
                            withTexture(kSame));
    EXPECT_EQ(draw(pack), draw(expected));
}

TEST_F(CMaterialTest, functionsTiltNormals)
{
    recreate(&hearth_test_functions_material_shaders);
    // 160 and 96 of 255: a map of one texel, nearly the slopes of the parameters
    const auto mapped = [](TestScene& scene, formats::MaterialRecord& material)
    {
        material.normal_texture =
            makeTextureRef(scene.addImage(formats::TexelFormat::rgba8_unorm, 1, 1, {0xFFFF60A0}));
    };
    const MaterialPack expected(doubleSided(plainMaterial()), "", mapped);
    const float x = 2.0f * 160 / 255 - 1, y = 2.0f * 96 / 255 - 1;
    const MaterialPack pack(doubleSided(plainMaterial()),
                            R"({"hearth_material":"bumps","hearth_parameters":[)" + std::to_string(x) + "," +
                                std::to_string(y) + "]}");
    hearth_frame frame = makeFrame();
    for (const uint32_t view : {HEARTH_VIEW_FINAL, HEARTH_VIEW_NORMALS})
    {
        frame.debug_view = view;
        const std::vector<uint32_t> color = draw(pack, frame), plain = draw(expected, frame);
        for (size_t i = 0; i < color.size(); ++i)
            for (uint32_t shift = 0; shift < 24; shift += 8)
                ASSERT_NEAR(static_cast<int>(color[i] >> shift & 255),
                            static_cast<int>(plain[i] >> shift & 255), 2)
                    << view << " " << i;
    }
}

TEST_F(CMaterialTest, otherRenderersDrawMaterialsAsThePackHasThem)
{
    const MaterialPack pack(unlit(), R"({"hearth_material":"stripes"})");
    const MaterialPack plain(unlit(), "");
    EXPECT_EQ(draw(pack), draw(plain));
    recreate(&hearth_test_functions_material_shaders);
    EXPECT_NE(draw(pack), draw(plain));
}

TEST_F(CMaterialTest, errorsNameTheMaterialAndTheRemedy)
{
    recreate(&hearth_test_functions_material_shaders);
    const auto refusal = [&](const char* extras)
    {
        const MaterialPack pack(unlit(), extras);
        draw(pack);
        EXPECT_EQ(result_, HEARTH_ERROR_USAGE) << extras;
        return std::string(hearth_last_error(renderer_));
    };
    EXPECT_THAT(refusal(R"({"hearth_material":"stripe"})"),
                AllOf(HasSubstr("rock.hearth"), HasSubstr("\"stripe\""), HasSubstr("stripes")));
    EXPECT_THAT(refusal(R"({"hearth_material":7})"), HasSubstr("stripes"));
    for (const char* parameters :
         {"7", "[1,,2]", "[1e99]", "[\"1\"]", "[null]", "[nan]", "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]"})
        EXPECT_THAT(
            refusal((R"({"hearth_material":"stripes","hearth_parameters":)" + std::string(parameters) + "}")
                        .c_str()),
            HasSubstr("at most 16 numbers"))
            << parameters;

    // another light method than the game has compiled
    hearth_material_shaders few = hearth_test_functions_material_shaders;
    std::vector<hearth_material_module> modules(few.modules, few.modules + few.module_count);
    std::erase_if(modules, [](const hearth_material_module& m)
                  { return std::string_view(m.name).find("marked") != std::string_view::npos; });
    few.modules = modules.data();
    few.module_count = modules.size();
    recreate(&few, HEARTH_FEATURE_DEFERRED);
    const MaterialPack pack(unlit(), R"({"hearth_material":"stripes"})");
    hearth_frame frame = makeFrame();
    draw(pack, frame);
    EXPECT_EQ(result_, HEARTH_OK) << hearth_last_error(renderer_);
    frame.light_method = HEARTH_LIGHTS_STACK;
    draw(pack, frame, HEARTH_TARGETS_STACK);
    EXPECT_EQ(result_, HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("hearth_add_material_shaders()"));

    hearth_material_shaders old = hearth_test_functions_material_shaders;
    old.version = "0123456789abcdef";
    hearth_renderer_description description = c_caller_description(caller_);
    description.material_shaders = &old;
    hearth_renderer* refused = nullptr;
    EXPECT_EQ(hearth_renderer_create(&description, &refused, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("build the game against"));
}

} // namespace hearth::test
