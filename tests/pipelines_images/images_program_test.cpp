// Tests that hearth-images is confined, that its failures are errors, and that only images that need it start
// it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/confine.h"
#include "pipelines/import/images/decode.h"
#include "tests/pipelines_images/frozen_jpeg2000.h"
#include "tests/pipelines_images/images_fixture.h"
#include "tests/support/sandbox.h"
#include "tests/support/sanitized.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::test
{

namespace
{

using images::Format;

TEST(Confinement, forbidsWhatDecodingDoesNotNeed)
{
    const pid_t child = ::fork();
    if (child == 0)
    {
        images::limitResources();
        const bool has_filter = images::closeDoors();
        const std::array<bool, 11> got_out{
            !has_filter,
            ::open("/etc/passwd", O_RDONLY) >= 0,
            ::open("/dev/null", O_WRONLY) >= 0,
            ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0,
            ::memfd_create("a", 0) >= 0,
            ::dup(0) >= 0,
            ::fork() >= 0,
            ::kill(::getppid(), 0) == 0,
            ::unlink("/nothing") == 0 || errno != EPERM,
            ::execl("/bin/true", "true", nullptr) == 0 || errno != EPERM,
            !kSanitized &&
                ::mmap(nullptr, size_t{5} << 30, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED,
        };
        int first = 0;
        for (size_t i = 0; i < got_out.size() && first == 0; ++i)
            first = got_out[i] ? static_cast<int>(i) + 1 : 0;
        ::_exit(first);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "the number of the first door that is open";
}

/// Decode by a program of this script.
Error failureOfScript(const std::string& script, std::chrono::milliseconds timeout = std::chrono::seconds(20))
{
    Sandbox folder;
    folder.write("program", "#!/bin/sh\n" + script + "\n", true);
    import::ImagesProgram program(folder / "program", timeout);
    const auto image = decode(Format::tiff, std::string(1 << 20, 'x'), {}, {}, program);
    return image.ok() ? Error{} : image.error();
}

TEST(ImagesProgram, whoseFailuresAreErrors)
{
    const auto expect = [](const Error& error, const std::string& detail)
    {
        EXPECT_EQ(error.issue, Issue::image_reader) << formatMessage(error);
        EXPECT_EQ(error.file, "file");
        EXPECT_NE(error.detail.find(detail), std::string::npos) << formatMessage(error);
        EXPECT_NE(formatMessage(error).find("convert the image to PNG"), std::string::npos);
    };
    expect(failureOfScript("exit 3"), "ended with exit code 3");
    expect(failureOfScript("kill -SEGV $$"), "was ended by signal 11");
    expect(failureOfScript("exec /bin/sleep 100", std::chrono::milliseconds(200)), "took more than 200 ms");
}

/// Answer with a header and then bytes for ever.
Error failureOfAnswer(const images::Answer& answer)
{
    std::string bytes(reinterpret_cast<const char*>(&answer), sizeof(answer)), octal;
    for (const char byte : bytes)
    {
        char text[8];
        std::snprintf(text, sizeof(text), "\\%03o", static_cast<unsigned char>(byte));
        octal += text;
    }
    // reads the request to its end, so that it is not cut off
    return failureOfScript("/bin/dd bs=1048616 count=1 iflag=fullblock of=/dev/null 2>/dev/null\nprintf '" +
                           octal + "'\nexec /bin/cat /dev/zero");
}

TEST(ImagesProgram, whoseAnswersAreNotTrusted)
{
    const images::Answer good{.width = 2, .height = 2, .type = 0, .texel_bytes = 16};
    EXPECT_EQ(failureOfAnswer(good).issue, Error{}.issue); // which means: it was decoded
    std::vector<images::Answer> wrong(8, good);
    wrong[0].magic = 1;
    wrong[1].text_size = 1u << 31;
    wrong[2].width = 1u << 31;
    wrong[3].height = 0;
    wrong[4].type = 3;
    wrong[5].texel_bytes = 17;
    wrong[6].texel_bytes = uint64_t{1} << 60;
    wrong[7].issue = static_cast<uint32_t>(Issue::internal);
    for (const images::Answer& answer : wrong)
    {
        const Error error = failureOfAnswer(answer);
        EXPECT_EQ(error.issue, Issue::image_reader) << formatMessage(error);
        EXPECT_NE(error.detail.find("gave an answer that is not one"), std::string::npos) << error.detail;
    }
}

TEST(ImagesProgram, thatIsMissingIsAnError)
{
    import::ImagesProgram program("/nowhere/hearth-images");
    const auto image = decode(Format::tiff, "II*", {}, {}, program);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(formatMessage(image.error()),
              "file: error: hearth-images, which reads it, cannot be started: No such file or directory "
              "[E1301] hint: save the image as PNG, JPEG, WebP, HDR or EXR");
}

TEST(ImagesProgram, isStartedOnlyByWhatNeedsIt)
{
    import::ImagesProgram program("/nowhere/hearth-images");
    for (const std::string& start :
         {std::string("\x89PNG\r\n\x1A\n"), std::string("\xFF\xD8\xFF"), std::string("BM"),
          std::string("#?RADIANCE"), std::string("\x76\x2F\x31\x01"), std::string("GIF8"),
          std::string("DDS ")})
    {
        const std::string file = start + std::string(100, '\0');
        const auto image =
            import::decodeImage(std::as_bytes(std::span(file)), "a", {}, {&program, "", false});
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().detail.find("hearth-images"), std::string::npos) << start;
    }
    for (const std::string& start :
         {std::string("II*\0", 4), std::string("MM\0*", 4), std::string("II+\0", 4), std::string("8BPS"),
          std::string("\0\0\0\x0CjP  \r\n\x87\n", 12), std::string("\xFF\x4F\xFF\x51")})
    {
        const auto image =
            import::decodeImage(std::as_bytes(std::span(start)), "a", {}, {&program, "", false});
        ASSERT_FALSE(image.ok());
        EXPECT_NE(image.error().detail.find("hearth-images"), std::string::npos) << start;
    }
}

TEST(ImagesProgram, readsTheCardOfHearthImport)
{
    Sandbox folder;
    TiffImage image{.width = 4, .height = 2, .samples = {}};
    for (uint64_t i = 0; i < 24; ++i)
        image.samples.push_back(i * 10);
    folder.write("a.tif", makeTiff({image}));
    const ProgramEnd end = folder.run({HEARTH_BIN "/hearth-import", "a.tif", "-o", "a.part"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.err, "");
    folder.write("b.tif", makeTiff({image}).substr(0, 60));
    const ProgramEnd cut = folder.run({HEARTH_BIN "/hearth-import", "b.tif", "-o", "b.part"});
    EXPECT_EQ(cut.exit_code, 65);
    EXPECT_NE(cut.err.find("b.tif: error: TIFF: "), std::string::npos) << cut.err;
}

/// Return small files of every format.
std::vector<std::pair<Format, std::string>> makeFiles()
{
    TiffImage rgba{.width = 9, .height = 7, .samples = std::vector<uint64_t>(252, 77), .channel_count = 4};
    rgba.extra = {1};
    TiffImage tiles = rgba;
    tiles.is_tiled = tiles.is_planar = true;
    TiffImage ink = rgba;
    ink.extra = {};
    ink.photometric = 5;
    ink.profile = std::string(300, 'p');
    PsdImage psd{
        .width = 9, .height = 7, .channel_count = 4, .samples = rgba.samples, .has_transparency = true};
    PsdImage packed = psd;
    packed.is_packed = packed.is_big = true;
    return {{Format::tiff, makeTiff({rgba})},
            {Format::tiff, makeTiff({tiles}, true)},
            {Format::tiff, makeTiff({ink})},
            {Format::psd, makePsd(psd)},
            {Format::psd, makePsd(packed)},
            {Format::jpeg2000, {reinterpret_cast<const char*>(kRgb8), sizeof(kRgb8)}},
            {Format::jpeg2000, {reinterpret_cast<const char*>(kGrey16), sizeof(kGrey16)}}};
}

TEST(ImagesProgram, survivesDamagedFiles)
{
    std::mt19937 random(1);
    size_t failures = 0;
    for (const auto& [format, file] : makeFiles())
    {
        const auto check = [&, format = format](const std::string& damaged)
        {
            const auto image = decode(format, damaged, {.convert_icc = true});
            if (!image.ok() && image.error().issue == Issue::image_reader)
                ++failures;
        };
        for (size_t i = 0; i < trials(60); ++i)
            check(file.substr(0, random() % file.size()));
        for (size_t i = 0; i < trials(200); ++i)
        {
            std::string damaged = file;
            for (uint32_t count = random() % 4 + 1; count > 0; --count)
                damaged[random() % std::min<size_t>(damaged.size(), i % 2 == 0 ? 120 : damaged.size())] ^=
                    static_cast<char>(1u << random() % 8);
            check(damaged);
        }
    }
    // each costs a new start of the program
    EXPECT_LE(failures, 3u);
    EXPECT_TRUE(decode(Format::tiff, makeFiles()[0].second).ok());
}

} // namespace

} // namespace hearth::test
