#pragma once

namespace cloth
{

/// Makes SIGINT and SIGTERM end a node cleanly, whenever they come. roscpp, left alone, ends on SIGINT alone, and not
/// while it still looks for its master. Before `ros::init`, which is to have the option NoSigintHandler.
void end_by_signal();

}  // namespace cloth
