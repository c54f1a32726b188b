// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/images_program.h"

#include "formats/base/half.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::import
{

namespace
{

// Notes of an answer that are kept.
constexpr size_t kMaxNotes = 8;

/// Return the variables that the program gets: the rest could change what OpenImageIO does.
std::vector<char*> chooseEnvironment()
{
    std::vector<char*> chosen;
    for (char** variable = environ; *variable != nullptr; ++variable)
    {
        const std::string_view text = *variable;
        const std::string_view name = text.substr(0, text.find('='));
        if (name == "LD_LIBRARY_PATH" || name.ends_with("SAN_OPTIONS"))
            chosen.push_back(*variable);
    }
    chosen.push_back(nullptr);
    return chosen;
}

/// Start a program whose standard input and output are `socket`. returns  its id, or -1 and errno
pid_t spawn(const std::string& path, int socket)
{
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    // libraries print damages of images; those that matter come in the answer
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string name = path;
    char* arguments[] = {name.data(), nullptr};
    pid_t process = -1;
    const int error =
        ::posix_spawn(&process, path.c_str(), &actions, nullptr, arguments, chooseEnvironment().data());
    ::posix_spawn_file_actions_destroy(&actions);
    errno = error;
    return error == 0 ? process : -1;
}

/// Make every half finite, as stored images are.
void clampHalves(DecodedImage& image)
{
    for (size_t i = 0; i < image.texels.size(); i += sizeof(uint16_t))
    {
        uint16_t bits = 0;
        std::memcpy(&bits, image.texels.data() + i, sizeof(bits));
        bits = halfFromFloat(floatFromHalf(bits));
        std::memcpy(image.texels.data() + i, &bits, sizeof(bits));
    }
}

/// Return the notes in the lines of a text, without those of issues that images do not have.
std::vector<ImageNote> parseNotes(std::string_view text)
{
    std::vector<ImageNote> notes;
    while (!text.empty() && notes.size() < kMaxNotes)
    {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        unsigned number = 0;
        const auto read = std::from_chars(line.data(), line.data() + line.size(), number);
        for (const Issue issue : {Issue::image_layers, Issue::image_depth, Issue::image_colors})
            if (number == static_cast<unsigned>(issue) && read.ptr != line.data() + line.size())
                notes.push_back({issue, std::string(read.ptr + 1, line.data() + line.size())});
    }
    return notes;
}

} // namespace

bool ImagesProgram::start()
{
    if (process_ > 0)
        return true;
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return false;
    process_ = spawn(path_, ends[1]);
    const int error = errno;
    ::close(ends[1]);
    if (process_ > 0)
        socket_ = ends[0];
    else
        ::close(ends[0]);
    was_started_ = was_started_ || process_ > 0;
    errno = error;
    return process_ > 0;
}

int ImagesProgram::end()
{
    if (process_ <= 0)
        return 0;
    // killed first: a closed socket would end it by another signal, which failure() would name
    ::kill(process_, SIGKILL);
    ::close(socket_);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR)
    {
    }
    process_ = -1;
    socket_ = -1;
    return status;
}

/// Wait until the socket is ready; false where the time is over.
bool ImagesProgram::waitFor(short events, Time deadline)
{
    for (;;)
    {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0)
            return false;
        pollfd file{socket_, events, 0};
        if (::poll(&file, 1, static_cast<int>(left.count())) > 0)
            return true;
    }
}

bool ImagesProgram::send(const void* data, size_t size, Time deadline)
{
    const auto* bytes = static_cast<const std::byte*>(data);
    while (size > 0)
    {
        if (!waitFor(POLLOUT, deadline))
            return false;
        const ssize_t sent = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno != EAGAIN && errno != EINTR)
            return false;
        bytes += std::max<ssize_t>(sent, 0);
        size -= static_cast<size_t>(std::max<ssize_t>(sent, 0));
    }
    return true;
}

bool ImagesProgram::receive(void* data, size_t size, Time deadline)
{
    auto* bytes = static_cast<std::byte*>(data);
    while (size > 0)
    {
        if (!waitFor(POLLIN, deadline))
            return false;
        const ssize_t got = ::recv(socket_, bytes, size, MSG_DONTWAIT);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR))
            return false;
        bytes += std::max<ssize_t>(got, 0);
        size -= static_cast<size_t>(std::max<ssize_t>(got, 0));
    }
    return true;
}

/// End the program after a failure, and describe it.
Error ImagesProgram::failure(const EncodedImage& source, Time deadline)
{
    const bool is_late = std::chrono::steady_clock::now() >= deadline;
    // a program that is ending may not have ended yet: its own end says more than ours
    for (int i = 0; i < 100 && !is_late; ++i)
    {
        siginfo_t ended{};
        if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
            ended.si_pid != 0)
            break;
        ::usleep(1000);
    }
    const int status = end();
    const std::string what = is_late ? "took more than " + std::to_string(timeout_.count()) + " ms"
                             : WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL
                                 ? std::string("was ended by signal ") + std::to_string(WTERMSIG(status)) +
                                       " (" + ::strsignal(WTERMSIG(status)) + ")"
                             : WIFEXITED(status)
                                 ? "ended with exit code " + std::to_string(WEXITSTATUS(status))
                                 : "gave an answer that is not one";
    return {Issue::image_reader, source.name, "", "hearth-images, which reads it, " + what};
}

Result<DecodedImage> ImagesProgram::receiveImage(const EncodedImage& source, const images::Answer& answer,
                                                 Time deadline)
{
    if (answer.magic != images::kAnswerMagic || answer.text_size > images::kMaxTextSize)
        return failure(source, deadline);
    std::string text(answer.text_size, '\0');
    if (!receive(text.data(), text.size(), deadline))
        return failure(source, deadline);
    if (answer.issue != 0)
    {
        for (const Issue issue : {Issue::image_malformed, Issue::image_unsupported, Issue::input_too_large})
            if (answer.issue == static_cast<uint32_t>(issue))
                return Error{issue, source.name, "", text};
        return failure(source, deadline);
    }
    if (answer.type > static_cast<uint32_t>(ChannelType::float16) ||
        !checkImageSize(source, answer.width, answer.height).ok())
        return failure(source, deadline);
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image, allocateImage(source, answer.width, answer.height,
                                                              static_cast<ChannelType>(answer.type)));
    if (answer.texel_bytes != image.texels.size() ||
        !receive(image.texels.data(), image.texels.size(), deadline))
        return failure(source, deadline);
    if (image.isFloat())
        clampHalves(image);
    image.notes = parseNotes(text);
    return image;
}

Result<DecodedImage> ImagesProgram::decode(images::Format format, const EncodedImage& source,
                                           const std::string& layer, bool convert_icc)
{
    const Time deadline = std::chrono::steady_clock::now() + timeout_;
    if (!start())
        return source.unsupported("hearth-images, which reads it, cannot be started: " +
                                  std::string(std::strerror(errno)));
    images::Request request;
    request.format = format;
    request.byte_count = source.bytes.size();
    request.max_texels = source.limits.max_image_texels;
    request.max_side = source.limits.max_image_size;
    request.convert_icc = convert_icc ? 1 : 0;
    request.layer_size = static_cast<uint32_t>(std::min<size_t>(layer.size(), images::kMaxLayerSize));
    images::Answer answer;
    if (!send(&request, sizeof(request), deadline) || !send(layer.data(), request.layer_size, deadline) ||
        !send(source.bytes.data(), source.bytes.size(), deadline) ||
        !receive(&answer, sizeof(answer), deadline))
        return failure(source, deadline);
    return receiveImage(source, answer, deadline);
}

} // namespace hearth::import
