// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace hearth::cli
{

namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using Words = std::vector<std::string>;

std::string getFault(CommandLine& command_line, const Words& words)
{
    return command_line.parseWords(words).fault;
}

} // namespace

TEST(CommandLine, setsVariablesOfEveryType)
{
    CommandLine command_line("Test");
    std::string text;
    int integer = 0;
    uint32_t small = 0;
    uint64_t large = 0;
    float single = 0;
    double number = 0;
    std::optional<uint32_t> maybe, never;
    bool flag = false, other_flag = false;
    command_line.addOption("TEXT", text, "");
    command_line.addOption("--integer", integer, "");
    command_line.addOption("--small", small, "");
    command_line.addOption("--large", large, "");
    command_line.addOption("--single", single, "");
    command_line.addOption("-n,--number", number, "");
    command_line.addOption("--maybe", maybe, "");
    command_line.addOption("--never", never, "");
    command_line.addFlag("-f,--flag", flag, "");
    command_line.addFlag("--other-flag", other_flag, "");
    ASSERT_EQ(getFault(command_line,
                       {"word", "--integer", "-3", "--small=4294967295", "--large", "18446744073709551615",
                        "--single", "0.5", "-n", "1e300", "--maybe", "7", "-f"}),
              "");
    EXPECT_EQ(text, "word");
    EXPECT_EQ(integer, -3);
    EXPECT_EQ(small, 4294967295u);
    EXPECT_EQ(large, 18446744073709551615u);
    EXPECT_EQ(single, 0.5f);
    EXPECT_EQ(number, 1e300);
    EXPECT_EQ(maybe, 7u);
    EXPECT_FALSE(never.has_value());
    EXPECT_TRUE(flag);
    EXPECT_FALSE(other_flag);
}

TEST(CommandLine, leavesVariablesOfOptionsThatAreNotGiven)
{
    CommandLine command_line("Test");
    std::string text = "before";
    uint32_t number = 5;
    Words words{"a"};
    command_line.addOption("--text", text, "");
    command_line.addOption("--number", number, "");
    command_line.addOption("--words", words, "");
    ASSERT_EQ(getFault(command_line, {}), "");
    EXPECT_EQ(text, "before");
    EXPECT_EQ(number, 5u);
    EXPECT_THAT(words, ElementsAre("a"));
}

TEST(CommandLine, listsTakeAllWordsOrOneEach)
{
    CommandLine command_line("Test");
    Words files, all, each;
    command_line.addOption("FILES", files, "");
    command_line.addOption("--all", all, "");
    command_line.addOption("--each", each, "").oneValueEach();
    ASSERT_EQ(getFault(command_line, {"--each", "1", "x", "--each", "2", "y", "--all", "3", "4"}), "");
    EXPECT_THAT(files, ElementsAre("x", "y"));
    EXPECT_THAT(all, ElementsAre("3", "4"));
    EXPECT_THAT(each, ElementsAre("1", "2"));
}

TEST(CommandLine, listsOfNumbersAreSplitAndCounted)
{
    CommandLine command_line("Test");
    std::vector<float> camera;
    std::vector<double> sizes;
    std::vector<std::vector<double>> points;
    command_line.addOption("--camera", camera, "").delimiter(',').expected(2);
    command_line.addOption("--sizes", sizes, "").delimiter(',');
    command_line.addOption("--point", points, "").delimiter(',').expected(3);
    ASSERT_EQ(getFault(command_line,
                       {"--camera", "1,2", "--sizes", "1", "2,3", "--point", "1,2,3", "--point", "4,5,6"}),
              "");
    EXPECT_THAT(camera, ElementsAre(1.0f, 2.0f));
    EXPECT_THAT(sizes, ElementsAre(1.0, 2.0, 3.0));
    EXPECT_THAT(points, ElementsAre(ElementsAre(1, 2, 3), ElementsAre(4, 5, 6)));
    EXPECT_THAT(getFault(command_line, {"--camera", "1"}), HasSubstr("--camera"));
}

TEST(CommandLine, optionalWordsAreThoseOfTheOptionAlone)
{
    struct Row
    {
        Words words;
        std::string mode, file;
    };
    for (const Row& row :
         {Row{{"cook", "a.glb"}, "auto", "a.glb"}, Row{{"cook", "--light", "a.glb"}, "on", "a.glb"},
          Row{{"cook", "a.glb", "--light"}, "on", "a.glb"},
          Row{{"cook", "--light", "off", "a.glb"}, "off", "a.glb"},
          Row{{"cook", "--light=off", "a.glb"}, "off", "a.glb"},
          Row{{"cook", "--light", "--", "off"}, "on", "off"}})
    {
        CommandLine command_line("Test");
        CommandLine& verb = command_line.addSubcommand("cook", "");
        std::string mode = "auto", file;
        verb.addOptionalChoice("--light", mode, {"auto", "on", "off"}, "on", "");
        verb.addOption("FILE", file, "");
        EXPECT_EQ(getFault(command_line, row.words), "");
        EXPECT_EQ(mode, row.mode);
        EXPECT_EQ(file, row.file);
    }
    CommandLine command_line("Test");
    std::string mode;
    command_line.addOptionalChoice("--light", mode, {"auto", "on", "off"}, "on", "");
    EXPECT_THAT(getFault(command_line, {"--light=dim"}), HasSubstr("dim"));
}

TEST(CommandLine, optionalNumbersAreFollowedByOtherWords)
{
    struct Row
    {
        Words words;
        std::optional<uint32_t> number;
        size_t count;
        std::string file;
    };
    for (const Row& row : {Row{{"extract", "a.pack"}, std::nullopt, 0, "a.pack"},
                           Row{{"extract", "--probe", "a.pack"}, std::nullopt, 1, "a.pack"},
                           Row{{"extract", "a.pack", "--probe"}, std::nullopt, 1, "a.pack"},
                           Row{{"extract", "--probe=all", "a.pack"}, std::nullopt, 1, "a.pack"},
                           Row{{"extract", "--probe", "0", "a.pack"}, 0, 1, "a.pack"},
                           Row{{"extract", "--probe=12", "a.pack"}, 12, 1, "a.pack"},
                           Row{{"extract", "--probe", "--", "7"}, std::nullopt, 1, "7"}})
    {
        CommandLine command_line("Test");
        CommandLine& verb = command_line.addSubcommand("extract", "");
        std::optional<uint32_t> number;
        std::string file;
        const Option option = verb.addOptionalNumber("--probe", number, "all", "");
        verb.addOption("FILE", file, "");
        EXPECT_EQ(getFault(command_line, row.words), "");
        EXPECT_EQ(number, row.number);
        EXPECT_EQ(option.count(), row.count);
        EXPECT_EQ(file, row.file);
    }
    for (const std::string word : {"--probe=first", "--probe=-1", "--probe=1.5", "--probe=4294967296"})
    {
        CommandLine command_line("Test");
        std::optional<uint32_t> number;
        command_line.addOptionalNumber("--probe", number, "all", "");
        EXPECT_THAT(getFault(command_line, {word}), HasSubstr("is not a whole number"));
    }
}

TEST(CommandLine, flagsMayHaveAValueOrNoVariable)
{
    CommandLine command_line("Test");
    std::string fatal;
    command_line.addFlag("--fatal{all}", fatal, "");
    const Option keeps_going = command_line.addFlag("-k,--keep-going", "");
    ASSERT_EQ(getFault(command_line, {"--fatal", "-k", "--keep-going"}), "");
    EXPECT_EQ(fatal, "all");
    EXPECT_EQ(keeps_going.count(), 2u);
    ASSERT_EQ(getFault(command_line, {"--fatal=W1"}), "");
    EXPECT_EQ(fatal, "W1");
    EXPECT_EQ(keeps_going.count(), 0u);
}

TEST(CommandLine, choicesOfAnEnumeration)
{
    enum class Color : uint8_t
    {
        red,
        green = 7
    };
    CommandLine command_line("Test");
    Color color = Color::red;
    command_line.addChoice("--color", color, {{"red", Color::red}, {"green", Color::green}}, "");
    ASSERT_EQ(getFault(command_line, {"--color", "green"}), "");
    EXPECT_EQ(color, Color::green);
    EXPECT_THAT(getFault(command_line, {"--color", "blue"}), HasSubstr("blue"));
}

TEST(CommandLine, refusesWordsThatAreNoNumber)
{
    CommandLine command_line("Test");
    uint32_t number = 0;
    double real = 0;
    command_line.addOption("--number", number, "");
    command_line.addOption("--real", real, "");
    EXPECT_THAT(getFault(command_line, {"--number", "x"}), HasSubstr("--number"));
    EXPECT_THAT(getFault(command_line, {"--number", "-1"}), HasSubstr("--number"));
    EXPECT_THAT(getFault(command_line, {"--number", "4294967296"}), HasSubstr("--number"));
    EXPECT_THAT(getFault(command_line, {"--real", "1m"}), HasSubstr("--real"));
    EXPECT_THAT(getFault(command_line, {"--unknown"}), HasSubstr("--unknown"));
    EXPECT_THAT(getFault(command_line, {"--number"}), HasSubstr("--number"));
}

TEST(CommandLine, holdsValuesToTheirRange)
{
    CommandLine command_line("Test");
    int integer = 0;
    uint32_t small = 0;
    uint64_t large = 0;
    double number = 0, distance = 0;
    command_line.addOption("--integer", integer, "").range(-1, 1);
    command_line.addOption("--small", small, "").range(1u, 3u);
    command_line.addOption("--large", large, "").range(uint64_t{1}, uint64_t{1} << 40);
    command_line.addOption("--number", number, "").range(0.0, 0.5);
    command_line.addOption("--distance", distance, "").positive();
    EXPECT_EQ(getFault(command_line, {"--integer", "-1", "--small", "3", "--large", "1099511627776",
                                      "--number", "0.5", "--distance", "1e-9"}),
              "");
    const std::vector<std::array<const char*, 2>> wrong{
        {"--integer", "2"},  {"--small", "0"},     {"--large", "1099511627777"}, {"--number", "0.6"},
        {"--number", "nan"}, {"--number", "-NaN"}, {"--distance", "nan"},        {"--distance", "0"}};
    for (const auto& [option, value] : wrong)
        EXPECT_THAT(getFault(command_line, {option, value}), HasSubstr("not in range")) << option;
}

TEST(CommandLine, holdsValuesToTheirChoicesAndChecks)
{
    CommandLine command_line("Test");
    std::string format, name;
    uint32_t block = 0;
    const std::array<uint32_t, 2> blocks{4, 8};
    command_line.addOption("--format", format, "").choices({"text", "json"});
    command_line.addOption("--block", block, "").choices(blocks);
    command_line.addOption("--name", name, "")
        .check([](const std::string& value) { return value == "bad" ? "this is bad" : ""; });
    EXPECT_EQ(getFault(command_line, {"--format", "json", "--block", "8", "--name", "good"}), "");
    EXPECT_THAT(getFault(command_line, {"--format", "xml"}), HasSubstr("xml not in {text,json}"));
    EXPECT_THAT(getFault(command_line, {"--block", "6"}), HasSubstr("6 not in {4,8}"));
    EXPECT_THAT(getFault(command_line, {"--name", "bad"}), HasSubstr("this is bad"));
}

TEST(CommandLine, holdsOptionsToEachOther)
{
    CommandLine command_line("Test");
    std::string file;
    bool a = false, b = false, c = false;
    command_line.addOption("FILE", file, "").required();
    const Option option_a = command_line.addFlag("-a", a, "");
    command_line.addFlag("-b", b, "").needs(option_a);
    command_line.addFlag("-c", c, "").excludes(option_a);
    EXPECT_EQ(getFault(command_line, {"file", "-a", "-b"}), "");
    EXPECT_EQ(getFault(command_line, {}), "FILE is required");
    EXPECT_THAT(getFault(command_line, {"file", "-b"}), HasSubstr("requires"));
    EXPECT_THAT(getFault(command_line, {"file", "-a", "-c"}), HasSubstr("excludes"));
}

TEST(CommandLine, checksTheWholeBeforeItActs)
{
    CommandLine command_line("Test");
    uint32_t number = 0;
    uint32_t acted_on = 0;
    command_line.addOption("--number", number, "");
    command_line.setCheck([&number] { return number > 5 ? "--number: too many" : ""; });
    command_line.setAction([&] { acted_on = number; });
    EXPECT_EQ(getFault(command_line, {"--number", "6"}), "--number: too many");
    EXPECT_EQ(acted_on, 0u);
    EXPECT_EQ(getFault(command_line, {"--number", "5"}), "");
    EXPECT_EQ(acted_on, 5u);
}

TEST(CommandLine, actsForTheSubcommandThatIsNamed)
{
    CommandLine command_line("Test", "tool");
    std::string directory, acted;
    command_line.addOption("-C", directory, "");
    for (const char* name : {"cook", "look"})
        command_line.addSubcommand(name, "").setAction([&acted, name] { acted += name; });
    command_line.addSubcommand("farm", "").addSubcommand("slurm", "").setAction([&] { acted += "slurm"; });
    command_line.requireSubcommand();
    EXPECT_THAT(getFault(command_line, {}), HasSubstr("subcommand is required"));
    EXPECT_FALSE(command_line.hasSubcommand());
    EXPECT_EQ(getFault(command_line, {"look"}), "");
    EXPECT_TRUE(command_line.hasSubcommand());
    EXPECT_EQ(acted, "look");
    EXPECT_EQ(getFault(command_line, {"farm", "slurm"}), "");
    EXPECT_EQ(acted, "lookslurm");
    // options of the whole stand before its subcommands, unless they are shared
    EXPECT_THAT(getFault(command_line, {"cook", "-C", "x"}), HasSubstr("-C"));
    command_line.shareOptions();
    EXPECT_EQ(getFault(command_line, {"cook", "-C", "x"}), "");
    EXPECT_EQ(directory, "x");
}

TEST(CommandLine, helpShowsTypesChoicesRangesAndDefaults)
{
    CommandLine command_line("Makes tests.", "tool");
    std::string format = "text", file, color;
    uint32_t count = 3, hidden = 0;
    command_line.addOption("--format", format, "how it is written").choices({"text", "json"}).showDefault();
    command_line.addOption("--file", file, "what to read").typeName("FILE");
    command_line.addOption("--color", color, "of text").choices({"red", "blue"}, "COLOR");
    command_line.addOption("--count", count, "how many").range(1u, 9u);
    command_line.addOption("--hidden", hidden, "range").range(1u, 77u, "N");
    command_line.setFooter("Example: tool --count 3");
    const std::string help = command_line.help();
    EXPECT_THAT(help, HasSubstr("Makes tests.\nUsage: tool [OPTIONS]\n"));
    EXPECT_THAT(help, HasSubstr("--format TEXT:{text,json}=text"));
    EXPECT_THAT(help, HasSubstr("--file FILE"));
    EXPECT_THAT(help, HasSubstr("--color COLOR "));
    EXPECT_THAT(help, HasSubstr("--count UINT:UINT in [1 - 9]"));
    EXPECT_THAT(help, HasSubstr("--hidden N "));
    EXPECT_THAT(help, Not(HasSubstr("77")));
    EXPECT_THAT(help, HasSubstr("\nExample: tool --count 3\n"));
}

TEST(CommandLine, helpIsAskedForInsteadOfWhatIsMissing)
{
    CommandLine command_line("Test", "tool");
    std::string file;
    command_line.addSubcommand("cook", "Cook it").addOption("FILE", file, "").required();
    command_line.requireSubcommand();
    for (const Words& words : {Words{"-h"}, Words{"--help"}, Words{"cook", "--help"}})
    {
        const ParseResult parsed = command_line.parseWords(words);
        EXPECT_TRUE(parsed.wants_help);
        EXPECT_EQ(parsed.fault, "");
    }
    EXPECT_THAT(command_line.help(), HasSubstr("Usage: tool cook [OPTIONS] FILE"));
}

TEST(CommandLine, programsEndWithZeroAfterHelpAndTwoAfterAnError)
{
    CommandLine command_line("Test", "tool");
    uint32_t number = 0;
    command_line.addOption("--number", number, "");
    const std::array<const char*, 3> right{"tool", "--number", "4"};
    EXPECT_EQ(command_line.parse(3, right.data()), std::nullopt);
    EXPECT_EQ(number, 4u);

    ::testing::internal::CaptureStdout();
    const std::array<const char*, 2> help{"tool", "--help"};
    EXPECT_EQ(command_line.parse(2, help.data()), 0);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), command_line.help());

    ::testing::internal::CaptureStderr();
    const std::array<const char*, 3> wrong{"tool", "--number", "x"};
    EXPECT_EQ(command_line.parse(3, wrong.data()), 2);
    EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("--number"));
}

TEST(CommandLine, describesItselfAsData)
{
    CommandLine command_line("Test", "tool");
    std::string directory, format, level, file;
    Words sources;
    uint32_t count = 0;
    bool flag = false;
    command_line.addOption("-C,--directory", directory, "work there").typeName("DIR");
    CommandLine& cook = command_line.addSubcommand("cook", "Cook it");
    cook.addOption("SOURCE", sources, "what to cook").required();
    cook.addOption("--format", format, "").choices({"text", "json"});
    cook.addOption("--level", level, "").typeName("low|high");
    cook.addOption("--count", count, "").range(1u, 9u);
    cook.addOption("-o", file, "").required();
    cook.addFlag("--flag", flag, "");
    cook.setFooter("Example");

    const CommandInfo info = command_line.info();
    EXPECT_EQ(info.name, "tool");
    EXPECT_EQ(info.description, "Test");
    ASSERT_EQ(info.options.size(), 2u) << "help is the first";
    EXPECT_THAT(info.options[0].names, ElementsAre("-h", "--help"));
    EXPECT_THAT(info.options[1].names, ElementsAre("-C", "--directory"));
    EXPECT_EQ(info.options[1].value, "DIR");
    EXPECT_EQ(info.options[1].description, "work there");

    ASSERT_EQ(info.subcommands.size(), 1u);
    const CommandInfo& verb = info.subcommands[0];
    EXPECT_EQ(verb.name, "cook");
    EXPECT_EQ(verb.description, "Cook it");
    EXPECT_EQ(verb.footer, "Example");
    ASSERT_EQ(verb.positionals.size(), 1u);
    EXPECT_THAT(verb.positionals[0].names, ElementsAre("SOURCE"));
    EXPECT_EQ(verb.positionals[0].value, "");
    EXPECT_TRUE(verb.positionals[0].is_required);
    EXPECT_TRUE(verb.positionals[0].may_repeat);
    ASSERT_EQ(verb.options.size(), 6u);
    EXPECT_THAT(verb.options[1].choices, ElementsAre("text", "json"));
    EXPECT_EQ(verb.options[1].value, "NAME");
    EXPECT_FALSE(verb.options[1].may_repeat);
    EXPECT_THAT(verb.options[2].choices, ElementsAre("low", "high"));
    EXPECT_THAT(verb.options[3].choices, IsEmpty());
    EXPECT_EQ(verb.options[3].value, "UINT");
    EXPECT_TRUE(verb.options[4].is_required);
    EXPECT_EQ(verb.options[5].value, "");
}

} // namespace hearth::cli
