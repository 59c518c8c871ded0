// Sockets of this machine (AF_UNIX) for streams. Nothing here waits, except where it says so.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace clues::scene {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }

 private:
  int release();

  int fd_ = -1;
};

// A socket that listens at the path. One that a killed server left there is replaced. Throws Error: bad_argument where the
// path is too long, another server listens or something else lies there; file_unwritable.
Descriptor listen_at(const std::filesystem::path& path);
// The next client; none: closed.
Descriptor accept_from(const Descriptor& listener);
// None where nobody listens. Throws Error bad_argument where the path is too long.
Descriptor connect_to(const std::filesystem::path& path);

enum class SocketIo { ok, later, lost };
// Appends what has come, up to 64 KiB. `later`: nothing is there.
SocketIo receive_some(const Descriptor& from, std::string& bytes);
// Takes away from the front what could be sent.
SocketIo send_some(const Descriptor& to, std::string& bytes);
// Waits until there is something to read, or room to write. False: the time is over.
bool wait_for(const Descriptor& descriptor, bool to_write, std::chrono::milliseconds time);

}  // namespace clues::scene
