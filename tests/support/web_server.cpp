// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/web_server.h"

#include "formats/base/assert.h"

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::test
{

namespace
{

constexpr const char* kNginx = "/usr/sbin/nginx";

sockaddr_in loopback(int port)
{
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

/// Open a socket that listens on a port that the system chooses.
int listenAnywhere(int& port)
{
    const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof(address);
    HEARTH_ASSERT(::bind(listener, reinterpret_cast<const sockaddr*>(&address), size) == 0);
    HEARTH_ASSERT(::listen(listener, 64) == 0);
    HEARTH_ASSERT(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    port = ntohs(address.sin_port);
    return listener;
}

bool answers(int port)
{
    const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    const bool connected =
        ::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    ::close(client);
    return connected;
}

constexpr const char* kConfig = R"(
daemon off;
master_process off;
pid FOLDER/pid;
error_log FOLDER/errors;
events { worker_connections 256; }
http {
  log_format short '$request_method $uri $status';
  access_log FOLDER/log short;
  client_body_temp_path FOLDER/tmp/body;
  proxy_temp_path FOLDER/tmp/proxy;
  fastcgi_temp_path FOLDER/tmp/fastcgi;
  uwsgi_temp_path FOLDER/tmp/uwsgi;
  scgi_temp_path FOLDER/tmp/scgi;
  client_max_body_size 0;
  server {
    listen 127.0.0.1:PORT;
    TLS
    root FOLDER/store;
    location ~ "^/(ac|cas)/[0-9a-f]{64}$" {
      dav_methods PUT;
      create_full_put_path on;
      DIRECTIVES
    }
  }
}
)";

void replaceAll(std::string& text, const std::string& word, const std::string& by)
{
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
        text.replace(at, word.size(), by);
}

std::string makeConfig(const std::string& folder, int port, const std::string& directives,
                       const std::string& tls)
{
    std::string config = kConfig;
    replaceAll(config, "PORT", std::to_string(port) + (tls.empty() ? "" : " ssl"));
    replaceAll(config, "TLS", tls);
    replaceAll(config, "DIRECTIVES", directives);
    replaceAll(config, "FOLDER", folder);
    return config;
}

} // namespace

int freePort()
{
    int port = 0;
    ::close(listenAnywhere(port));
    return port;
}

// ---- nginx

bool WebServer::isInstalled()
{
    return ::access(kNginx, X_OK) == 0;
}

WebServer::WebServer(std::string folder, const std::string& directives)
    : folder_(std::move(folder)), port_(freePort())
{
    std::filesystem::create_directories(folder_ + "/tmp");
    std::filesystem::create_directories(store());
    start(directives);
}

void WebServer::start(const std::string& directives, const std::string& tls)
{
    stop();
    const std::string config = folder_ + "/config";
    std::ofstream(config) << makeConfig(folder_, port_, directives, tls);
    process_ = ::fork();
    HEARTH_ASSERT(process_ >= 0);
    if (process_ == 0)
    {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::dup2(::open((folder_ + "/output").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600), STDERR_FILENO);
        ::execl(kNginx, kNginx, "-c", config.c_str(), "-e", (folder_ + "/errors").c_str(), nullptr);
        ::_exit(127);
    }
    for (int wait = 0; wait < 1000 && !answers(port_); ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    HEARTH_ASSERT(answers(port_));
}

void WebServer::stop()
{
    if (process_ == 0)
        return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
}

std::vector<std::string> WebServer::log()
{
    stop();
    std::vector<std::string> lines;
    std::ifstream file(folder_ + "/log");
    for (std::string line; std::getline(file, line);)
        // skip lines of the probe that tests whether the server accepts connections
        if (!line.starts_with(" "))
            lines.push_back(line);
    return lines;
}

// ---- one answer for all

FixedServer::FixedServer(std::string answer)
    : answer_(std::move(answer)), socket_(listenAnywhere(port_)), thread_([this] { serve(); })
{
}

FixedServer::~FixedServer()
{
    // wakes accept
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
}

void FixedServer::serve()
{
    for (;;)
    {
        const int client = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
        if (client < 0)
            return;
        char request[4096];
        static_cast<void>(::recv(client, request, sizeof(request), 0));
        static_cast<void>(::send(client, answer_.data(), answer_.size(), MSG_NOSIGNAL));
        ::shutdown(client, SHUT_WR);
        // read further data: closing a socket with unread data would discard the answer
        while (::recv(client, request, sizeof(request), 0) > 0)
        {
        }
        ::close(client);
    }
}

// ---- no answer at all

SilentServer::SilentServer() : socket_(listenAnywhere(port_)) {}

SilentServer::~SilentServer()
{
    ::close(socket_);
}

} // namespace hearth::test
