// Tests the bindings for Python and C#: layouts, defaults and constants equal the C compiler's, the examples
// draw the image of the example in C, errors and callbacks follow the rules; headers that bindings cannot
// have are refused.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_pack.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

const std::string kBindings = HEARTH_SOURCE_FOLDER "/runtime/c/bindings";
const std::string kExamples = kBindings + "/examples";
constexpr const char* kNoMono = "mono is not installed: mono-mcs and mono-runtime of Debian";
constexpr const char* kNoDevice = "there is no Vulkan device";
const std::string kTests = HEARTH_SOURCE_FOLDER "/tests/bindings";

class Bindings : public ::testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite() { folder_.reset(); }

    static Sandbox& folder() { return *folder_; }

    /// Run a shell command that finds the built libraries and Python modules.
    static ProgramEnd shell(const std::string& command)
    {
        return folder().run(
            {"/bin/bash", "-c", command},
            {"LD_LIBRARY_PATH=" + fs::path(HEARTH_LIBRARY).parent_path().string() + ":" HEARTH_BINDINGS,
             "PYTHONPATH=" HEARTH_BINDINGS ":" + kExamples, "PYTHONDONTWRITEBYTECODE=1",
             "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation"});
    }

    /// Run a command that must succeed; return its output on stdout and stderr.
    static std::string run(const std::string& command)
    {
        const ProgramEnd end = shell(command);
        EXPECT_EQ(end.exit_code, 0) << command << "\n" << end.out << end.err;
        return end.out + end.err;
    }

    static std::string python(const std::string& script) { return HEARTH_PYTHON " " + script; }

    /// Compile a C# source with the binding to an executable of the sandbox.
    static void compile(const std::string& source, const std::string& executable)
    {
        EXPECT_EQ(run("mcs -warn:4 -out:" + executable + " " HEARTH_BINDINGS "/Hearth.cs " + source), "");
    }

    /// Write the compiler's table, with the functions of both libraries, to the sandbox.
    static void writeTable()
    {
        std::string table = run(HEARTH_TESTS "/hearth_binding_layout");
        std::istringstream symbols(
            run("nm -D --defined-only --format=just-symbols " HEARTH_LIBRARY " " HEARTH_HELPERS_LIBRARY));
        size_t count = 0;
        for (std::string symbol; std::getline(symbols, symbol);)
            if (symbol.starts_with("hearth_"))
            {
                table += "function " + symbol.substr(0, symbol.find('@')) + "\n";
                ++count;
            }
        EXPECT_GT(count, 50u);
        folder().write("table", table);
    }

    /// Expect that a PPM file has the image that the example in C draws.
    static void expectImageOfC(const std::string& ppm)
    {
        const Result<viewer::Image> image = viewer::readPng(folder() / "c.png");
        ASSERT_TRUE(image.ok()) << formatMessage(image.error());
        const std::string head = "P6 640 480 255\n";
        EXPECT_TRUE(folder().read(ppm) == head + std::string(image->rgb.begin(), image->rgb.end()));
        EXPECT_GT((std::set<uint8_t>(image->rgb.begin(), image->rgb.end()).size()), 50u)
            << "nothing is drawn";
    }

    static std::unique_ptr<Sandbox> folder_;
    static bool has_device_, has_mono_;
};

std::unique_ptr<Sandbox> Bindings::folder_;
bool Bindings::has_device_ = false, Bindings::has_mono_ = false;

/// Write a pack and the image that the example in C draws of it.
void Bindings::SetUpTestSuite()
{
    folder_ = std::make_unique<Sandbox>();
    const AlignedBytes bytes = smallPack().bytes();
    folder().write("small.hearth", {reinterpret_cast<const char*>(bytes.span().data()), bytes.size()});
    const ProgramEnd end = shell(HEARTH_TESTS "/hearth_draw_image small.hearth c.png");
    has_device_ = end.err.find("hint: install a Vulkan driver") == std::string::npos;
    if (has_device_)
        EXPECT_EQ(end.out + end.err, "");
    has_mono_ = shell("command -v mcs && command -v mono").exit_code == 0;
}

/// Return the names that a pattern finds in the headers, by its first group.
std::set<std::string> findNames(const std::string& text, const std::string& pattern)
{
    std::set<std::string> names;
    const std::regex regex(pattern);
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        names.insert((*at)[1]);
    return names;
}

std::string readHeaders()
{
    Sandbox sandbox; // reads files of any folder
    std::string text;
    for (const char* name : {"hearth.h", "hearth_helpers.h"})
        text += sandbox.run({"/bin/cat", HEARTH_SOURCE_FOLDER "/runtime/c/" + std::string(name)}).out;
    return std::regex_replace(text, std::regex(R"(/\*[^*]*\*+([^/*][^*]*\*+)*/)"), "");
}

} // namespace

TEST_F(Bindings, loseNoNameOfTheHeaders)
{
    const std::string table = run(HEARTH_TESTS "/hearth_binding_layout"), text = readHeaders();
    const std::set<std::string> structs = findNames(text, R"(\n\} (hearth_\w+);)");
    EXPECT_GT(structs.size(), 30u);
    for (const std::string& name : structs)
        EXPECT_EQ(countOccurrences(table, "struct " + name + " "), 1u) << name;
    const std::set<std::string> constants = findNames(text, R"(\n *(HEARTH_[A-Z0-9_]+) *=)");
    EXPECT_GT(constants.size(), 100u);
    for (const std::string& name : constants)
        EXPECT_EQ(countOccurrences(table, "constant " + name + " "), 1u) << name;
    const std::set<std::string> defaults = findNames(text, R"(#define (HEARTH_\w+)_INIT)");
    EXPECT_EQ(countOccurrences(table, "default "), defaults.size());
}

TEST_F(Bindings, havePythonStructsAsTheCompilerHasThem)
{
    writeTable();
    EXPECT_EQ(run(python(kTests + "/check_layout.py table")), "");
}

TEST_F(Bindings, haveCSharpStructsAsTheCompilerHasThem)
{
    if (!has_mono_)
        GTEST_SKIP() << kNoMono;
    writeTable();
    compile(kTests + "/CheckLayout.cs", "layout.exe");
    EXPECT_EQ(run("mono layout.exe table"), "");
}

TEST_F(Bindings, drawTheImageOfCInPython)
{
    if (!has_device_)
        GTEST_SKIP() << kNoDevice;
    EXPECT_EQ(run(python(kExamples + "/draw_image.py small.hearth python.ppm")), "");
    expectImageOfC("python.ppm");
    const ProgramEnd bad = shell(python(kExamples + "/draw_image.py none.hearth python.ppm"));
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.err, ::testing::StartsWith("draw_image.py: none.hearth: error: "));
}

TEST_F(Bindings, drawTheImageOfCInCSharp)
{
    if (!has_mono_)
        GTEST_SKIP() << kNoMono;
    if (!has_device_)
        GTEST_SKIP() << kNoDevice;
    compile(kExamples + "/DrawImage.cs", "draw.exe");
    EXPECT_EQ(run("mono draw.exe small.hearth csharp.ppm"), "");
    expectImageOfC("csharp.ppm");
    const ProgramEnd bad = shell("mono draw.exe none.hearth csharp.ppm");
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.err, ::testing::StartsWith("DrawImage: none.hearth: error: "));
}

TEST_F(Bindings, keepTheRulesInPython)
{
    if (!has_device_)
        GTEST_SKIP() << kNoDevice;
    EXPECT_EQ(run(python(kTests + "/check_rules.py small.hearth")), "");
}

TEST_F(Bindings, keepTheRulesInCSharp)
{
    if (!has_mono_)
        GTEST_SKIP() << kNoMono;
    if (!has_device_)
        GTEST_SKIP() << kNoDevice;
    compile(kTests + "/CheckRules.cs", "rules.exe");
    EXPECT_EQ(run("mono rules.exe small.hearth"), "");
}

TEST_F(Bindings, haveADocumentWhoseCodeIsThatOfTests)
{
    const auto read = [](const std::string& path) { return run("cat " + path); };
    const std::string sources = read(kExamples + "/draw_image.py " + kTests + "/check_rules.py ") +
                                read(kExamples + "/DrawImage.cs " + kTests + "/CheckRules.cs");
    std::istringstream document(read(HEARTH_SOURCE_FOLDER "/docs/bindings.md"));
    size_t count = 0;
    bool is_code = false;
    for (std::string line; std::getline(document, line);)
        if (line.starts_with("```"))
            is_code = line == "```python" || line == "```csharp";
        else if (is_code)
        {
            ++count;
            EXPECT_NE(sources.find(" " + line + "\n"), std::string::npos) << line;
        }
    EXPECT_GT(count, 30u);
}

TEST_F(Bindings, refuseHeadersThatTheyDoNotUnderstand)
{
    EXPECT_EQ(run(python(kTests + "/check_refusals.py " + kBindings)), "");
    folder().write("bad.h", "#define HEARTH_API_VERSION 1u\nHEARTH_API int hearth_f(VkStrange value);\n");
    const ProgramEnd end = shell(
        python(kBindings + "/make_bindings.py --header bad.h libbad.so.1 --python bad.py --csharp Bad.cs"));
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_EQ(end.out, "");
    EXPECT_EQ(
        end.err,
        "make_bindings.py: error: bad.h:2: unknown type VkStrange: add it to VULKAN_TYPES of c_header.py\n");
    EXPECT_FALSE(folder().has("bad.py") || folder().has("Bad.cs"));
}

} // namespace hearth::test
