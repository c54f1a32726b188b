// main() of every test program.
//
// --sources=a_test.cpp,b_test.cpp runs only the tests of these files, so that one program serves several
// entries of ctest. A filter that leaves out tests, such as GTEST_FILTER=-Suite.*, leaves them out here, too.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace
{

constexpr std::string_view kSourcesOption = "--sources=";

std::vector<std::string_view> splitAtCommas(std::string_view list)
{
    std::vector<std::string_view> words;
    while (!list.empty())
    {
        const size_t end = std::min(list.find(','), list.size());
        words.push_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return words;
}

/// Return "Suite.test:" for each test of a source file; empty if it has none.
std::string filterFor(std::string_view source)
{
    std::string filter;
    const testing::UnitTest& program = *testing::UnitTest::GetInstance();
    for (int i = 0; i < program.total_test_suite_count(); ++i)
    {
        const testing::TestSuite& suite = *program.GetTestSuite(i);
        for (int j = 0; j < suite.total_test_count(); ++j)
        {
            const testing::TestInfo& test = *suite.GetTestInfo(j);
            const std::string_view file = test.file();
            if (file.substr(file.rfind('/') + 1) == source) // npos + 1 is 0
                filter += std::string(suite.name()) + "." + test.name() + ":";
        }
    }
    return filter;
}

/// Restrict the run to the tests of some files. Returns false, with a message, if a *_test.cpp among them has
/// none: it would never run.
bool selectSources(std::string_view list)
{
    std::string filter;
    for (const std::string_view source : splitAtCommas(list))
    {
        const std::string of_source = filterFor(source);
        if (of_source.empty() && source.ends_with("_test.cpp"))
        {
            std::fprintf(stderr, "%.*s has no tests in this program\n", static_cast<int>(source.size()),
                         source.data());
            return false;
        }
        filter += of_source;
    }
    if (filter.empty())
        std::fprintf(stderr, "%s%.*s selects no test\n", kSourcesOption.data(), static_cast<int>(list.size()),
                     list.data());
    const std::string asked = testing::GTEST_FLAG(filter);
    if (asked.starts_with('-'))
        filter += asked;
    testing::GTEST_FLAG(filter) = filter;
    return !filter.empty();
}

} // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleMock(&argc, argv);
    for (int i = 1; i < argc; ++i)
        if (const std::string_view argument = argv[i]; argument.starts_with(kSourcesOption))
            if (!selectSources(argument.substr(kSourcesOption.size())))
                return 1;
    return RUN_ALL_TESTS();
}
