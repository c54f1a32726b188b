// Tests a game in a separate project: it finds Hearth, cooks as part of its build, and renders.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/consumer/installation.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <optional>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

constexpr int kNoDevice = 77;
const std::string kTexture = "game/assets/painted board.png";

struct Image
{
    std::string texels = std::string(size_t{128} * 128 * 3, '\0');

    /// Return red, green and blue at a position given as fractions of the image's sides.
    std::array<int, 3> at(double x, double y) const
    {
        const size_t first = 3 * (static_cast<size_t>(y * 128) * 128 + static_cast<size_t>(x * 128));
        const auto byte = [&](size_t i) { return int{static_cast<unsigned char>(texels.at(first + i))}; };
        return {byte(0), byte(1), byte(2)};
    }
};

class Consumer : public Installation
{
protected:
    /// Configure a copy of the game for a generator in the folder `build`.
    void configure(const std::string& generator)
    {
        fs::remove_all(folder() / "game");
        fs::remove_all(folder() / "build");
        fs::copy(HEARTH_SOURCE_FOLDER "/tests/consumer/game", folder() / "game", fs::copy_options::recursive);
        run(HEARTH_CMAKE " -S game -B build -G '" + generator +
            "' -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DCMAKE_BUILD_TYPE=Debug");
    }

    std::string build(const std::string& target)
    {
        return run(HEARTH_CMAKE " --build build --target " + target);
    }

    void touchTexture() { fs::last_write_time(folder() / kTexture, fs::file_time_type::clock::now()); }
    void paintTexture()
    {
        fs::copy_file(HEARTH_SOURCE_FOLDER "/tests/consumer/repainted.png", folder() / kTexture,
                      fs::copy_options::overwrite_existing);
        touchTexture();
    }

    /// Return the frame that the game renders; nothing without a device.
    std::optional<Image> drawn(const std::string& game)
    {
        const ProgramEnd end = shell("build/" + game + " build/game.hearth image.ppm");
        if (end.exit_code == kNoDevice)
            return std::nullopt;
        EXPECT_EQ(end.exit_code, 0) << end.err;
        const std::string image = folder().read("image.ppm");
        const std::string head = "P6 128 128 255\n";
        EXPECT_TRUE(image.starts_with(head));
        EXPECT_EQ(image.size(), head.size() + Image().texels.size());
        return Image{image.substr(std::min(head.size(), image.size()))};
    }

    /// Check that a changed texture rebuilds the pack, and that nothing is rebuilt without a change.
    void cookWhatHasChanged(const std::string& target, const std::string& pack)
    {
        const std::string first = build(target);
        EXPECT_EQ(countOccurrences(first, "Cooking " + pack), 1u) << first;
        const std::string cooked = folder().read("build/" + pack);
        EXPECT_EQ(countOccurrences(build(target), "Cooking"), 0u);

        touchTexture();
        EXPECT_EQ(countOccurrences(build(target), "Cooking " + pack), 1u);
        EXPECT_EQ(folder().read("build/" + pack), cooked);
        EXPECT_EQ(countOccurrences(build(target), "Cooking"), 0u);

        paintTexture();
        EXPECT_EQ(countOccurrences(build(target), "Cooking " + pack), 1u);
        EXPECT_NE(folder().read("build/" + pack), cooked);
        EXPECT_EQ(countOccurrences(build(target), "Cooking"), 0u);
    }
};

} // namespace

TEST_F(Consumer, drawsWhatItsBuildHasCooked)
{
    configure("Ninja");
    build("all");
    EXPECT_EQ(run("build/version"), "1.8: ok\n");
    EXPECT_EQ(run("build/pack_triangles build/game.hearth"), "2\n");
    EXPECT_EQ(run("build/pack_triangles 'build/packs/two signs.hearth'"), "4\n");
    EXPECT_EQ(shell("build/pack_triangles game/CMakeLists.txt").exit_code, 65);
    const std::optional<Image> image = drawn("game");
    if (!image)
        GTEST_SKIP() << "there is no Vulkan device";
    // the board's left half is red, its right half green
    const std::array<int, 3> left = image->at(0.3, 0.5);
    const std::array<int, 3> right = image->at(0.7, 0.5);
    EXPECT_GT(left[0], 2 * left[1]);
    EXPECT_GT(right[1], 2 * right[0]);
    EXPECT_NE(image->at(0.02, 0.02), left);
    EXPECT_NE(image->at(0.02, 0.02), right);
    // the game's material function paints the edge blue
    const std::array<int, 3> edge = image->at(0.5, 0.14);
    EXPECT_GT(edge[2], 2 * std::max(edge[0], edge[1]));
    EXPECT_EQ(drawn("game_static")->texels, image->texels);

    paintTexture();
    const std::string again = build("all");
    EXPECT_EQ(countOccurrences(again, "Linking"), 0u) << again;
    const Image painted = drawn("game").value();
    EXPECT_GT(painted.at(0.3, 0.5)[2], 2 * painted.at(0.3, 0.5)[0]);
    EXPECT_EQ(painted.at(0.7, 0.5)[1], right[1]);
    EXPECT_NE(build("all").find("no work to do"), std::string::npos);
}

TEST_F(Consumer, ninjaCooksWhatHasChanged)
{
    configure("Ninja");
    cookWhatHasChanged("game_game_hearth", "game.hearth");
}

TEST_F(Consumer, makeCooksWhatHasChanged)
{
    configure("Unix Makefiles");
    cookWhatHasChanged("signs", "packs/two signs.hearth");
}

TEST_F(Consumer, aCookThatFailsFailsTheBuild)
{
    configure("Ninja");
    folder().write("game/assets/sign.gltf", "{");
    const ProgramEnd end = shell(HEARTH_CMAKE " --build build --target game_game_hearth");
    EXPECT_NE(end.exit_code, 0);
    EXPECT_NE(end.out.find("[E1"), std::string::npos) << end.out;
    EXPECT_FALSE(folder().has("build/game.hearth"));
}

TEST_F(Consumer, saysWhatItsCallsLack)
{
    const auto configured = [&](const std::string& text, const std::string& arguments = "")
    {
        fs::create_directory(folder() / "wrong");
        fs::remove_all(folder() / "wrong-build");
        folder().write("wrong/CMakeLists.txt",
                       "cmake_minimum_required(VERSION 3.25)\nproject(wrong LANGUAGES NONE)\n" + text);
        return shell(HEARTH_CMAKE " -S wrong -B wrong-build -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" " +
                     arguments);
    };
    const std::string find = "find_package(hearth CONFIG REQUIRED COMPONENTS formats)\n";
    EXPECT_EQ(configured(find + "hearth_add_assets(a SOURCES a.glb)\n").exit_code, 0);
    for (const char* call : {"hearth_add_assets(a)", "hearth_add_assets(a SOURCES a.glb OUTPUT)",
                             "hearth_add_assets(a b.glb SOURCES a.glb)"})
        EXPECT_NE(configured(find + call).err.find("needs SOURCES FILE"), std::string::npos) << call;
    for (const char* call : {"hearth_add_material_shaders(a)", "hearth_add_material_shaders(a FUNCTIONS)"})
        EXPECT_NE(configured(find + call).err.find("needs FUNCTIONS FILE"), std::string::npos) << call;
    EXPECT_NE(configured(find + "hearth_add_assets(a SOURCES a.glb)\n", "-DHEARTH_PROGRAM=")
                  .err.find("HEARTH_PROGRAM=PATH"),
              std::string::npos);
    EXPECT_NE(configured("find_package(hearth CONFIG REQUIRED COMPONENTS window)\n").err.find("window"),
              std::string::npos);
    EXPECT_NE(configured("find_package(hearth 9 CONFIG REQUIRED)\n").exit_code, 0);
}

} // namespace hearth::test
