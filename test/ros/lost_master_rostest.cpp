#include <algorithm>
#include <csignal>
#include <stdexcept>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

#include "child_process.h"
#include "listener.h"

namespace cloth
{
namespace
{

std::string free_port()
{
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t length = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (socket < 0 || bind(socket, any, sizeof address) != 0 || getsockname(socket, any, &length) != 0)
  {
    throw std::runtime_error("no free port");
  }
  close(socket);
  return std::to_string(ntohs(address.sin_port));
}

bool master_answers(const std::string& port)
{
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  request[0] = "/cloth_test";
  XmlRpc::XmlRpcClient client("localhost", std::stoi(port), "/");
  return client.execute("getPid", request, response);
}

std::vector<std::string> with_master(const std::string& port, const std::vector<std::string>& command)
{
  std::vector<std::string> words{ "env", "ROS_MASTER_URI=http://localhost:" + port, "PYTHONUNBUFFERED=1" };
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

size_t lines(const ChildProcess& process)
{
  const std::string output = process.output();
  return static_cast<size_t>(std::count(output.begin(), output.end(), '\n'));
}

TEST(LostMaster, TheClothAndWhoListensToItGoOn)
{
  const std::string port = free_port();
  ChildProcess master({ "rosmaster", "--core", "-p", port });
  ChildProcess node(with_master(port, { CLOTH_NODE, "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8" }));
  // Which rostopic, unlike the node, does not wait for.
  ASSERT_TRUE(wait_until([&] { return master_answers(port); }));
  ChildProcess listener(with_master(port, { "rostopic", "echo", "-p", "/cloth_node/state/sim_time" }));
  ASSERT_TRUE(wait_until([&] { return lines(listener) > 20; })) << listener.output() << node.output();

  master.signal(SIGKILL);
  ASSERT_TRUE(wait_until([&] { return master.exit_status().has_value(); }));
  const size_t before = lines(listener);
  EXPECT_TRUE(wait_until([&] { return lines(listener) > before + 150; })) << "longer than stats and diagnostics need";
  EXPECT_FALSE(node.exit_status().has_value());
  node.signal(SIGINT);
  ASSERT_TRUE(wait_until([&] { return node.exit_status().has_value(); }));
  EXPECT_EQ(*node.exit_status(), 0) << node.output();
}

}  // namespace
}  // namespace cloth
