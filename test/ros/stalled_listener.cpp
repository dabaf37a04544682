#include "stalled_listener.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <netdb.h>
#include <ros/master.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

namespace cloth
{
namespace
{

struct Address
{
  std::string host;
  int port = 0;
};

Address address_of(const std::string& node)
{
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = "/cloth_test";
  request[1] = node;
  std::uint32_t port = 0;
  Address address;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(static_cast<std::string>(uri), address.host, port))
  {
    throw std::runtime_error("there is no node " + node);
  }
  address.port = static_cast<int>(port);
  return address;
}

/// Where the node hands out the topic.
Address address_of(const std::string& node, const std::string& topic)
{
  const Address api = address_of(node);
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  request[0] = "/cloth_test";
  request[1] = topic;
  request[2][0][0] = "TCPROS";
  XmlRpc::XmlRpcClient client(api.host.c_str(), api.port, "/");
  if (!client.execute("requestTopic", request, response) || static_cast<int>(response[0]) != 1)
  {
    throw std::runtime_error(node + " does not hand out " + topic);
  }
  return { static_cast<std::string>(response[2][1]), static_cast<int>(response[2][2]) };
}

int connected_socket(const Address& address)
{
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found) != 0)
  {
    throw std::runtime_error("no address for " + address.host);
  }
  const int socket = ::socket(found->ai_family, found->ai_socktype, found->ai_protocol);
  const int small = 4096;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  const int result = connect(socket, found->ai_addr, found->ai_addrlen);
  freeaddrinfo(found);
  if (result != 0)
  {
    close(socket);
    throw std::runtime_error("no connection to " + address.host);
  }
  return socket;
}

void append(std::vector<char>& bytes, std::uint32_t number)
{
  for (int i = 0; i < 4; ++i)
  {
    bytes.push_back(static_cast<char>(number >> (8 * i)));
  }
}

/// The header of a connection, as TCPROS has it: each field and the whole with its length in front.
std::vector<char> header_for(const std::string& topic)
{
  std::vector<char> fields;
  for (const std::string& field :
       { std::string("callerid=/stalled"), "topic=" + topic, std::string("md5sum=*"), std::string("type=*") })
  {
    append(fields, static_cast<std::uint32_t>(field.size()));
    fields.insert(fields.end(), field.begin(), field.end());
  }
  std::vector<char> bytes;
  append(bytes, static_cast<std::uint32_t>(fields.size()));
  bytes.insert(bytes.end(), fields.begin(), fields.end());
  return bytes;
}

}  // namespace

StalledListener::StalledListener(const std::string& node, const std::string& topic)
  : socket_(connected_socket(address_of(node, topic)))
{
  const std::vector<char> header = header_for(topic);
  char answer = 0;
  if (send(socket_, header.data(), header.size(), 0) != static_cast<ssize_t>(header.size()) ||
      recv(socket_, &answer, 1, 0) != 1)
  {
    close(socket_);
    throw std::runtime_error(node + " does not answer for " + topic);
  }
}

StalledListener::~StalledListener()
{
  close(socket_);
}

}  // namespace cloth
