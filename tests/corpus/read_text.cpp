// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/read_text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace hearth::corpus
{

std::string readText(const std::string& path, size_t max_size)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    std::string text(error ? 0 : static_cast<size_t>(std::min<uintmax_t>(size, max_size)), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<size_t>(file.gcount()));
    return text;
}

bool isControlCharacter(char c)
{
    return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F;
}

std::vector<std::string> splitLines(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

} // namespace hearth::corpus
