#include "cloth_sim/model/spring_batch.h"

namespace cloth
{

const char* name_of(SpringKind kind)
{
  switch (kind)
  {
    case SpringKind::structural:
      return "structural";
    case SpringKind::shear:
      return "shear";
    case SpringKind::flex:
      return "flex";
  }
  return "";
}

}  // namespace cloth
