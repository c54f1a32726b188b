// Runs hearth-specular as a user would.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/specular/rows.h"
#include "formats/pack/pack_check.h"
#include "formats/scene/reflectance_table.h"
#include "formats/scene/sheen_table.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>
#include <span>
#include <sstream>

namespace hearth::test
{

using namespace specular;

namespace
{

const std::string kHeader = "aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z\n";

class SpecularProgram : public ::testing::Test
{
protected:
    ProgramEnd specular(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-specular");
        return folder.run(arguments);
    }

    /// Table of a part in the folder.
    formats::SpecularTableRecord table(const std::string& name)
    {
        auto reader = formats::ContainerReader::open(folder / name);
        EXPECT_TRUE(reader.ok());
        EXPECT_EQ(reader->kind(), formats::ContainerKind::part);
        const auto view = formats::PackView::read(std::move(reader).value());
        EXPECT_TRUE(view.ok() && formats::checkSpecular(*view).ok());
        EXPECT_EQ(view->specularTables().size(), 1u);
        return view->specularTables()[0];
    }

    /// Check that --evaluate of this text ends with the expected result and leaves no files behind.
    void expectRefused(const std::string& text, const std::string& part)
    {
        folder.write("rows.csv", text);
        const ProgramEnd end = specular({"--evaluate", "rows.csv", "-o", "out.csv"});
        EXPECT_EQ(end.exit_code, 65) << part;
        EXPECT_EQ(countOccurrences(end.err, "\n"), 1u) << end.err;
        EXPECT_NE(end.err.find("rows.csv|" + part), std::string::npos) << end.err;
        EXPECT_NE(end.err.find("[E1601] hint: "), std::string::npos) << end.err;
        EXPECT_EQ(folder.list(), std::vector<std::string>{"rows.csv"});
    }

    Sandbox folder;
};

} // namespace

TEST_F(SpecularProgram, writesAPartWithItsSettings)
{
    ASSERT_EQ(specular({"-o", "a.part"}).exit_code, 0);
    EXPECT_EQ(table("a.part").masking, 1u);
    EXPECT_EQ(table("a.part").spacing, 0u);
    EXPECT_EQ(table("a.part").normal_lambda, 0.4f);
    ASSERT_EQ(specular({"-o", "b.part", "--masking", "separable", "--normal-lambda", "0.78", "--spacing",
                        "half-sine"})
                  .exit_code,
              0);
    EXPECT_EQ(table("b.part").masking, 0u);
    EXPECT_EQ(table("b.part").spacing, 1u);
    EXPECT_EQ(table("b.part").normal_lambda, 0.78f);
    EXPECT_NE(folder.read("a.part"), folder.read("b.part"));
}

TEST_F(SpecularProgram, writesTheSameBytesWithAnyNumberOfThreads)
{
    ASSERT_EQ(specular({"-o", "one.part", "-j", "1"}).exit_code, 0);
    ASSERT_EQ(specular({"-o", "four.part", "-j", "4"}).exit_code, 0);
    EXPECT_EQ(folder.read("one.part"), folder.read("four.part"));
}

TEST_F(SpecularProgram, writesTheTableAsATexture)
{
    const std::pair<const char*, size_t> blocks[] = {{"4", 64 * 4}, {"6", 43 * 3}, {"8", 32 * 2}};
    for (const auto& [block, count] : blocks)
    {
        ASSERT_EQ(specular({"--astc", "a.astc", "--astc-block", block}).exit_code, 0);
        const std::string file = folder.read("a.astc");
        ASSERT_EQ(file.size(), 16 + 16 * count);
        EXPECT_EQ(file.substr(0, 4), "\x13\xAB\xA1\x5C");
        EXPECT_EQ(file.substr(7, 9), std::string("\0\1\0\x10\0\0\1\0\0", 9)) << "256 x 16 x 1";
    }
    EXPECT_EQ(specular({"--astc", "a.astc", "--astc-block", "5"}).exit_code, 2);
    EXPECT_EQ(specular({"--astc", "a.astc", "--fit"}).exit_code, 2);
    EXPECT_EQ(specular({"--astc", "no/such/a.astc"}).exit_code, 73);
}

/// Expect the nodes of a written table. They may differ in the last bit of a half: libraries differ in their
/// transcendental functions.
void expectNodes(const std::string& text, const std::string& name, std::span<const uint64_t> nodes)
{
    size_t at = text.find(name + "{");
    for (const uint64_t node : nodes)
    {
        at = text.find("0x", at + 1);
        ASSERT_NE(at, std::string::npos);
        const uint64_t written = std::stoull(text.substr(at, 18), nullptr, 16);
        for (int value = 0; value < 4; ++value)
            EXPECT_LE(std::abs(static_cast<int>(written >> (16 * value) & 0xFFFFu) -
                               static_cast<int>(node >> (16 * value) & 0xFFFFu)),
                      1);
    }
    EXPECT_EQ(text.find("0x", at + 1), std::string::npos);
}

TEST_F(SpecularProgram, writesTheReflectanceThatShadingReads)
{
    ASSERT_EQ(specular({"--reflectance", "table.h"}).exit_code, 0);
    expectNodes(folder.read("table.h"), "kReflectanceTable", shared::kReflectanceTable);
    ASSERT_EQ(specular({"--sheen", "sheen.h"}).exit_code, 0);
    expectNodes(folder.read("sheen.h"), "kSheenTable", shared::kSheenTable);
}

TEST_F(SpecularProgram, evaluatesRowsInTheirOrder)
{
    folder.write("rows.csv",
                 kHeader + "1.5707963,0.5,0,0,0,1\n\n0,0.5,0,0,0,1\n0.6, 0.7, 0.9, 0.3, -0.2, 2\r\n");
    ASSERT_EQ(specular({"--evaluate", "rows.csv", "-o", "out.csv"}).exit_code, 0);
    std::istringstream lines(folder.read("out.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "table,fit");
    std::getline(lines, line);
    EXPECT_EQ(line, "1.000000,1.000000");
    std::getline(lines, line);
    EXPECT_EQ(line, "0.000000,0.000000");
    std::getline(lines, line);
    const double size = std::sqrt(0.09 + 0.04 + 4);
    const Configuration configuration{0.6, 0.7, 0.9, {0.3 / size, -0.2 / size, 2 / size}};
    EXPECT_NEAR(std::stof(line.substr(line.find(',') + 1)), fitOcclusion(configuration), 1e-5);
    const TableValues values = unpackTable(packTable(cookTable({}), {}));
    EXPECT_NEAR(std::stof(line), tableOcclusion(configuration, values, SpecularSpacing::cosine), 1e-5);
    EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(SpecularProgram, refusesRowsThatAreNone)
{
    expectRefused("", "line 1: ");
    expectRefused("a,b\n", "line 1: ");
    expectRefused(kHeader + "1,0.5,0,0,0\n", "line 2: error: has 5 columns");
    expectRefused(kHeader + "1,0.5,0,0,0,1,\n", "line 2: error: has 7 columns");
    expectRefused(kHeader + "1,0.5,0,0,0,1\n1,0.5,x,0,0,1\n", "line 3: error: 'x' is not a number");
    expectRefused(kHeader + "1,0.5,,0,0,1\n", "line 2: error: '' is not a number");
    expectRefused(kHeader + "1,nan,0,0,0,1\n", "line 2: error: 'nan' is not a number");
    expectRefused(kHeader + "1.6,0.5,0,0,0,1\n", "line 2: error: aperture_rad 1.6 ");
    expectRefused(kHeader + "1,1.5,0,0,0,1\n", "line 2: error: roughness 1.5 ");
    expectRefused(kHeader + "1,0.5,-0.1,0,0,1\n", "line 2: error: theta_o_rad -0.1 ");
    expectRefused(kHeader + "1,0.5,0,0,0,0\n", "line 2: error: the axis has no direction");
}

TEST_F(SpecularProgram, endsWithTheHousesExitCodes)
{
    EXPECT_EQ(specular({"--help"}).exit_code, 0);
    EXPECT_EQ(specular({}).exit_code, 2);
    EXPECT_EQ(specular({"--colour"}).exit_code, 2);
    EXPECT_EQ(specular({"-o", "a", "--masking", "none"}).exit_code, 2);
    EXPECT_EQ(specular({"-o", "a", "--normal-lambda", "1.5"}).exit_code, 2);
    EXPECT_EQ(specular({"-o", "a", "--normal-lambda", "nan"}).exit_code, 2);
    EXPECT_EQ(specular({"--evaluate", "missing.csv"}).exit_code, 2) << "without -o";
    EXPECT_EQ(specular({"--evaluate", "missing.csv", "-o", "out.csv"}).exit_code, 66);
    EXPECT_EQ(specular({"-o", "no/such/folder.part"}).exit_code, 73);
    EXPECT_TRUE(folder.list().empty());
}

TEST_F(SpecularProgram, reportsWhatItCompared)
{
    const ProgramEnd end = specular({"--report", "report.json", "--configurations", "20"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_NE(end.out.find("20 random configurations"), std::string::npos) << end.out;
    const auto report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(report["configurations"], 20);
    // 8 bits a texel are as exact as the part's bytes; 2 bits a texel are not
    ASSERT_EQ(report["astc"].size(), 3u);
    EXPECT_LT(report["astc"][0]["rms"].get<double>(), 0.005);
    EXPECT_LT(report["astc"][2]["rms"].get<double>(), 0.05);
    EXPECT_LT(report["astc"][0]["rms"].get<double>(), report["astc"][2]["rms"].get<double>());
    const ProgramEnd fit = specular({"--fit", "--configurations", "100"});
    EXPECT_EQ(fit.exit_code, 0);
    EXPECT_NE(fit.out.find("SpecularFit("), std::string::npos);
}

} // namespace hearth::test
