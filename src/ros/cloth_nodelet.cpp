#include <memory>
#include <thread>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "cloth_node.h"
#include "fault_log.h"
#include "node_scene.h"

namespace cloth
{

/// The cloth node inside of a nodelet manager, in a thread of its own.
class ClothNodelet : public nodelet::Nodelet
{
public:
  ClothNodelet() = default;
  ClothNodelet(const ClothNodelet&) = delete;
  ClothNodelet& operator=(const ClothNodelet&) = delete;

  ~ClothNodelet() override
  {
    if (thread_.joinable())
    {
      node_->stop();
      thread_.join();
    }
  }

private:
  /// A scene with a fault is logged and thrown: the manager then refuses to load.
  void onInit() override
  {
    try
    {
      const ros::NodeHandle& private_node = getPrivateNodeHandle();
      node_ = std::make_unique<ClothNode>(private_node, scene_from_parameters(private_node.getNamespace()));
    }
    catch (const std::exception& error)
    {
      log_fault(error);
      throw;
    }
    thread_ = std::thread([this] { run(); });
  }

  void run()
  {
    try
    {
      node_->run();
    }
    catch (const std::exception& error)
    {
      log_fault(error);
    }
  }

  std::unique_ptr<ClothNode> node_;
  std::thread thread_;
};

}  // namespace cloth

PLUGINLIB_EXPORT_CLASS(cloth::ClothNodelet, nodelet::Nodelet)
