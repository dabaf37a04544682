#include "wind_time_out.h"

namespace cloth
{

WindTimeOut::WindTimeOut(double seconds) : seconds_(seconds)
{
}

void WindTimeOut::restart(const ros::Time& now)
{
  since_ = now;
}

bool WindTimeOut::is_over(const ros::Time& now)
{
  if (!since_ || seconds_ == 0.0)
  {
    return false;
  }
  if (since_->isZero() || now < *since_)
  {
    since_ = now;
  }
  if ((now - *since_).toSec() <= seconds_)
  {
    return false;
  }
  since_.reset();
  return true;
}

}  // namespace cloth
