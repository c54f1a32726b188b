// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::test
{

namespace
{

std::string makeFolder()
{
    std::string path = (std::filesystem::temp_directory_path() / "hearth-test-XXXXXX").string();
    HEARTH_ASSERT(::mkdtemp(path.data()) != nullptr);
    return path;
}

std::string readFile(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

} // namespace

Sandbox::Sandbox() : path_(makeFolder()), output_path_(makeFolder()) {}

Sandbox::~Sandbox()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    std::filesystem::remove_all(output_path_, ignored);
}

void Sandbox::write(const std::string& name, const std::string& content, bool executable) const
{
    std::ofstream(*this / name, std::ios::binary) << content;
    if (executable)
        std::filesystem::permissions(*this / name, std::filesystem::perms::owner_all);
}

std::string Sandbox::read(const std::string& name) const
{
    return readFile(*this / name);
}

bool Sandbox::has(const std::string& name) const
{
    return std::filesystem::exists(*this / name);
}

std::vector<std::string> Sandbox::list() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
        names.push_back(entry.path().lexically_relative(path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> Sandbox::cacheContents() const
{
    std::vector<std::string> paths;
    for (const auto& file : std::filesystem::recursive_directory_iterator(cachePath() + "/cas"))
        if (file.is_regular_file())
            paths.push_back(file.path().string());
    return paths;
}

pid_t Sandbox::start(const std::vector<std::string>& command, const std::vector<std::string>& environment)
{
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    const std::string out = output_path_ + "/out";
    const std::string err = output_path_ + "/err";

    const pid_t process = ::fork();
    HEARTH_ASSERT(process >= 0);
    if (process != 0)
        return process;
    // use neither the cache nor the settings of the user who runs the tests
    ::setenv("HEARTH_CACHE", cacheSpec().c_str(), 1);
    ::setenv("XDG_CONFIG_HOME", (output_path_ + "/config").c_str(), 1);
    for (const std::string& variable : environment)
        ::putenv(const_cast<char*>(variable.c_str()));
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    if (::chdir(path_.c_str()) != 0 || ::dup2(::open(out.c_str(), flags, 0600), STDOUT_FILENO) < 0 ||
        ::dup2(::open(err.c_str(), flags, 0600), STDERR_FILENO) < 0)
        ::_exit(126);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
}

std::string Sandbox::errSoFar() const
{
    return readFile(output_path_ + "/err");
}

ProgramEnd Sandbox::finish(pid_t process) const
{
    int status = 0;
    ::waitpid(process, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(output_path_ + "/out"),
            readFile(output_path_ + "/err")};
}

size_t countOccurrences(const std::string& text, const std::string& part)
{
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

void replaceAll(std::string& text, const std::string& what, const std::string& by)
{
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

std::vector<std::string> withoutLightCookers(std::vector<std::string> words)
{
    for (const char* option : {"--visibility", "--bricks"})
        if (std::ranges::count(words, option) == 0)
            words.insert(words.end(), {option, "off"});
    return words;
}

} // namespace hearth::test
