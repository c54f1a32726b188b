// Runs hearth-probe as a user would.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_check.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class ProbeProgram : public ::testing::Test
{
protected:
    ProgramEnd probe(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-probe");
        return folder.run(arguments);
    }

    /// Write a Radiance image of 8 x 4 texels, brighter from left to right.
    void writeSky(const std::string& name)
    {
        std::string file = "#?RADIANCE\n\n-Y 4 +X 8\n";
        for (int i = 0; i < 32; ++i)
            file += {static_cast<char>(100 + i % 8), '\x50', '\x40', '\x81'};
        folder.write(name, file);
    }

    Sandbox folder;
};

} // namespace

TEST_F(ProbeProgram, writesAPartForAnyNumberOfThreads)
{
    writeSky("sky.hdr");
    ASSERT_EQ(probe({"sky.hdr", "-o", "one.part", "-j", "1", "--face-size", "32"}).exit_code, 0);
    ASSERT_EQ(probe({"sky.hdr", "-o", "four.part", "-j", "4", "--face-size", "32"}).exit_code, 0);
    EXPECT_EQ(folder.read("one.part"), folder.read("four.part"));

    auto reader = formats::ContainerReader::open(folder / "one.part");
    ASSERT_TRUE(reader.ok());
    EXPECT_EQ(reader->kind(), formats::ContainerKind::part);
    const auto view = formats::PackView::read(std::move(reader).value());
    ASSERT_TRUE(view.ok());
    EXPECT_TRUE(formats::checkProbes(*view).ok());
    ASSERT_EQ(view->probes().size(), 1u);
    EXPECT_EQ(view->probes()[0].face_size, 32u);
    EXPECT_EQ(view->probes()[0].mip_count, 6u);
    EXPECT_NEAR(view->probes()[0].irradiance.y, 3.14159265f * 80 / 128, 1e-5);
}

TEST_F(ProbeProgram, endsWithTheHousesExitCodes)
{
    writeSky("sky.hdr");
    folder.write("text.hdr", "a text");
    EXPECT_EQ(probe({"--help"}).exit_code, 0);
    EXPECT_EQ(probe({}).exit_code, 2);
    EXPECT_EQ(probe({"sky.hdr"}).exit_code, 2) << "without -o";
    EXPECT_EQ(probe({"sky.hdr", "-o", "a.part", "--face-size", "100"}).exit_code, 2);
    EXPECT_EQ(probe({"none.hdr", "-o", "a.part"}).exit_code, 66);
    const ProgramEnd text = probe({"text.hdr", "-o", "a.part"});
    EXPECT_EQ(text.exit_code, 65);
    EXPECT_NE(text.err.find("text.hdr: error: an environment is"), std::string::npos) << text.err;
    EXPECT_NE(text.err.find("[E1301] hint: "), std::string::npos) << text.err;
    EXPECT_EQ(probe({"sky.hdr", "-o", "no/such/a.part", "--face-size", "32"}).exit_code, 73);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"sky.hdr", "text.hdr"}));
}

} // namespace hearth::test
