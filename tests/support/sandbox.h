// Temporary folder of a test, and programs that run in it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace hearth::test
{

struct ProgramEnd
{
    int exit_code = -1; ///< -1 if a signal ended it
    std::string out;
    std::string err;
};

/// Temporary folder that is removed with all its contents.
class Sandbox
{
public:
    Sandbox();
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    const std::string& path() const { return path_; }
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

    void write(const std::string& name, const std::string& content, bool executable = false) const;
    std::string read(const std::string& name) const;
    bool has(const std::string& name) const;
    /// Return the names of everything in the folder and below, sorted.
    std::vector<std::string> list() const;

    /// Folder of the cache that programs use, outside of this folder.
    std::string cachePath() const { return output_path_ + "/cache"; }
    std::string cacheSpec() const { return "dir:" + cachePath(); }
    /// Return the paths of the contents in the cache.
    std::vector<std::string> cacheContents() const;

    /// Start a program in this folder; its output goes to files outside of it.
    pid_t start(const std::vector<std::string>& command, const std::vector<std::string>& environment = {});
    /// Return the text that the started program has written to stderr so far.
    std::string errSoFar() const;
    /// Wait for the program of start().
    ProgramEnd finish(pid_t process) const;
    ProgramEnd run(const std::vector<std::string>& command, const std::vector<std::string>& environment = {})
    {
        return finish(start(command, environment));
    }

private:
    std::string path_;
    std::string output_path_;
};

/// Count the occurrences of `part` in `text`.
size_t countOccurrences(const std::string& text, const std::string& part);

/// Replace every `what` in `text` by `by`.
void replaceAll(std::string& text, const std::string& what, const std::string& by);

/// Add options that switch off what a cook bakes for the light to the words of a command, unless it names
/// them itself: for tests that count or replace cookers.
std::vector<std::string> withoutLightCookers(std::vector<std::string> words);

} // namespace hearth::test
