// One thread and poll: an answer is a lookup, and takes no time beside sending it.
#include "app/stream/socket_server.h"

#include <fmt/format.h>
#include <poll.h>

#include <list>
#include <string>
#include <vector>

#include "app/common.h"
#include "app/interrupt.h"
#include "scene/stream/local_socket.h"

namespace clues::app {
namespace {

constexpr std::size_t most_clients = 256;  // who comes then waits until one goes

struct ServedClient {
  scene::Descriptor socket;
  reference::StreamSession session;
  std::string to_send;
  bool lost = false;
};

// Sends before it reads: a request waits until the answer to the one before has gone.
void attend(ServedClient& client) {
  using scene::SocketIo;
  auto io = SocketIo::ok;
  while (!client.to_send.empty() && io == SocketIo::ok) {
    io = scene::send_some(client.socket, client.to_send);
    if (client.to_send.empty()) client.to_send = client.session.answer_next();
  }
  if (io == SocketIo::ok && client.to_send.empty() && !client.session.is_over()) {
    std::string bytes;
    io = scene::receive_some(client.socket, bytes);
    client.session.feed(bytes);
    client.to_send = client.session.answer_next();
  }
  client.lost = io == SocketIo::lost || (client.session.is_over() && client.to_send.empty());
}

}  // namespace

void serve_at(const std::filesystem::path& path, const reference::StreamStore& store,
              const scene::StreamHeader& header) {
  const auto& interrupted = catch_interrupts();
  const scene::Descriptor listener = scene::listen_at(path);
  print(fmt::format("listening at {}\n", path.string()));
  std::fflush(stdout);
  std::list<ServedClient> clients;
  while (!interrupted) {
    std::vector<pollfd> polled{{clients.size() < most_clients ? listener.get() : -1, POLLIN, 0}};
    for (const auto& client : clients)
      polled.push_back({client.socket.get(), static_cast<short>(client.to_send.empty() ? POLLIN : POLLOUT), 0});
    constexpr int look_up_ms = 1000;  // for an interrupt between the test above and poll
    if (poll(polled.data(), polled.size(), look_up_ms) <= 0) continue;
    std::size_t i = 1;
    for (auto& client : clients) {
      if (polled[i++].revents != 0) attend(client);
    }
    clients.remove_if([](const ServedClient& client) { return client.lost; });
    if (polled[0].revents == 0) continue;
    scene::Descriptor arrived = scene::accept_from(listener);
    if (!arrived.is_open()) continue;
    reference::StreamSession session(store, header);
    std::string greeting = session.greeting();
    clients.push_back({std::move(arrived), std::move(session), std::move(greeting), false});
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

}  // namespace clues::app
