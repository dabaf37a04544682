#include "errands.h"

#include <utility>

namespace cloth
{
namespace
{

const Answer node_ends{ false, "the node ends" };

}  // namespace

Answer Errands::send(Errand errand)
{
  std::packaged_task<Answer()> task(std::move(errand));
  std::future<Answer> answer = task.get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_)
    {
      return node_ends;
    }
    waiting_.push_back(std::move(task));
  }
  try
  {
    return answer.get();
  }
  catch (const std::future_error&)  // its task was thrown away
  {
    return node_ends;
  }
}

void Errands::do_all()
{
  std::vector<std::packaged_task<Answer()>> tasks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks.swap(waiting_);
  }
  for (std::packaged_task<Answer()>& task : tasks)
  {
    task();
  }
}

bool Errands::any_waiting() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return !waiting_.empty();
}

void Errands::close()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  waiting_.clear();
}

}  // namespace cloth
