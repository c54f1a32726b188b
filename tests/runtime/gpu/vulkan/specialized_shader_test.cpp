// Tests that specialized shaders are valid and small.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/specialized_shader.h"

#include "formats/gpu_shared/specialization.h"
#include "tests/runtime/shaders/shader_list.h"
#include "tests/runtime/shaders/test_shaders.h"
#include "tests/support/sanitized.h"

#include <array>
#include <gtest/gtest.h>
#include <random>
#define SPV_ENABLE_UTILITY_CODE
#include <spirv-tools/libspirv.hpp>
#include <spirv_cross/spirv.hpp>
#include <string>

namespace hearth::test
{

namespace
{

using Constants = std::array<uint32_t, shared::kConstantCount>;

Constants randomConstants(std::mt19937& random)
{
    Constants constants;
    for (uint32_t& constant : constants)
        constant = static_cast<uint32_t>(random() % 6);
    return constants;
}

/// Return what Khronos's validator says against a module; empty for a valid one.
std::string findFault(const std::vector<uint32_t>& words)
{
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    std::string fault;
    tools.SetMessageConsumer([&fault](spv_message_level_t, const char*, const spv_position_t&,
                                      const char* message) { fault += message; });
    if (!tools.Validate(words) && fault.empty())
        fault = "not valid";
    return fault;
}

size_t count(std::span<const uint32_t> words, std::initializer_list<spv::Op> ops)
{
    size_t found = 0;
    for (size_t at = 5; at < words.size(); at += words[at] >> spv::WordCountShift)
        for (const spv::Op op : ops)
            found += (words[at] & spv::OpCodeMask) == static_cast<uint32_t>(op) ? 1 : 0;
    return found;
}

size_t countSpecializationConstants(std::span<const uint32_t> words)
{
    return count(words, {spv::OpSpecConstant, spv::OpSpecConstantTrue, spv::OpSpecConstantFalse,
                         spv::OpSpecConstantComposite, spv::OpSpecConstantOp});
}

} // namespace

TEST(SpecializedShaderTest, allShadersAreValidWithAnyConstants)
{
    std::mt19937 random(1);
    size_t with_constants = 0;
    for (const ListedShader& shader : listedShaders())
    {
        with_constants += countSpecializationConstants(shader.words) > 0 ? 1 : 0;
        for (size_t round = 0; round < trials(4); ++round)
        {
            const auto specialized = gpu::specializeShader(shader.words, randomConstants(random));
            ASSERT_TRUE(specialized.has_value()) << shader.name;
            EXPECT_EQ(findFault(*specialized), "") << shader.name;
            EXPECT_EQ(countSpecializationConstants(*specialized), 0u) << shader.name;
            EXPECT_LE(specialized->size(), shader.words.size()) << shader.name;
        }
    }
    EXPECT_GT(with_constants, 50u);
}

TEST(SpecializedShaderTest, branchesOfAllConstantsAreValid)
{
    std::mt19937 random(2);
    for (size_t round = 0; round < trials(300); ++round)
    {
        const auto specialized = gpu::specializeShader(shaders::branches_comp, randomConstants(random));
        ASSERT_TRUE(specialized.has_value());
        ASSERT_EQ(findFault(*specialized), "") << round;
    }
}

/// A plain opaque material needs a small part of what shading can do.
TEST(SpecializedShaderTest, plainMaterialsHaveAThirdOfTheirShader)
{
    Constants constants{};
    constants[shared::kConstantUsedSlices] = 1;
    for (const ListedShader& shader : listedShaders())
        if (std::string(shader.name) == "shading_frag")
        {
            const auto specialized = gpu::specializeShader(shader.words, constants);
            ASSERT_TRUE(specialized.has_value());
            EXPECT_LT(3 * specialized->size(), shader.words.size());
            return;
        }
    FAIL() << "there is no such shader";
}

TEST(SpecializedShaderTest, constantsWithoutAValueHaveTheirDefault)
{
    // kMode = 1, kSums = false, kCount = 3, kOffset = -2, kScale = 1.5, kMask = 0
    const uint32_t defaults[] = {1, 0, 3, 0xFFFFFFFEu, 0x3FC00000u, 0};
    const auto expected = gpu::specializeShader(shaders::branches_comp, defaults);
    EXPECT_EQ(gpu::specializeShader(shaders::branches_comp, {}), expected);
    EXPECT_EQ(gpu::specializeShader(shaders::branches_comp, std::span(defaults).first(2)), expected);
    const uint32_t others[] = {2, 0, 3};
    EXPECT_NE(gpu::specializeShader(shaders::branches_comp, others), expected);
}

} // namespace hearth::test
