#include "scene/stream/local_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.empty() || text.size() >= sizeof address.sun_path)
    throw Error(ErrorCode::bad_argument, text + ": the path of a socket has 1 to " +
                                             std::to_string(sizeof address.sun_path - 1) +
                                             " bytes; take a shorter one");
  std::memcpy(address.sun_path, text.data(), text.size());
  return address;
}

Descriptor new_socket() {
  Descriptor made(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made.is_open()) throw std::system_error(errno, std::generic_category(), "socket");
  return made;
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    if (fd_ >= 0) close(fd_);
    fd_ = other.release();
  }
  return *this;
}

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

int Descriptor::release() { return std::exchange(fd_, -1); }

Descriptor listen_at(const std::filesystem::path& path) {
  const sockaddr_un address = address_of(path);
  std::error_code ignored;
  if (std::filesystem::is_socket(path, ignored)) {
    const Descriptor probe = new_socket();
    const bool is_open = connect(probe.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (is_open || errno != ECONNREFUSED)  // busy, or somebody else's: not ours to remove
      throw Error(ErrorCode::bad_argument,
                  path.string() + ": another server listens there, or may not be asked; give another path");
    std::filesystem::remove(path, ignored);
  }
  Descriptor made = new_socket();
  if (bind(made.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    if (errno == EADDRINUSE)
      throw Error(ErrorCode::bad_argument, path.string() + ": something lies there; give another path");
    fail_unwritable(path, "cannot make a socket", errno);
  }
  if (listen(made.get(), SOMAXCONN) != 0) fail_unwritable(path, "cannot listen", errno);
  return made;
}

Descriptor accept_from(const Descriptor& listener) {
  return Descriptor(accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
}

Descriptor connect_to(const std::filesystem::path& path) {
  const sockaddr_un address = address_of(path);
  Descriptor made = new_socket();
  if (connect(made.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return {};
  return made;
}

SocketIo receive_some(const Descriptor& from, std::string& bytes) {
  std::array<char, 65536> buffer;
  const auto got = recv(from.get(), buffer.data(), buffer.size(), 0);
  if (got > 0) bytes.append(buffer.data(), static_cast<std::size_t>(got));
  if (got > 0) return SocketIo::ok;
  return got < 0 && (errno == EAGAIN || errno == EINTR) ? SocketIo::later : SocketIo::lost;
}

SocketIo send_some(const Descriptor& to, std::string& bytes) {
  const auto sent = send(to.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent < 0) return errno == EAGAIN || errno == EINTR ? SocketIo::later : SocketIo::lost;
  bytes.erase(0, static_cast<std::size_t>(sent));
  return SocketIo::ok;
}

bool wait_for(const Descriptor& descriptor, bool to_write, std::chrono::milliseconds time) {
  pollfd polled{descriptor.get(), static_cast<short>(to_write ? POLLOUT : POLLIN), 0};
  return poll(&polled, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace clues::scene
