#include "core/effects/type.h"

double hci_effect_value(const hci_effect *effect, size_t parameter)
{
    for (size_t k = 0; k < effect->count; ++k)
        if (effect->term[k].parameter == parameter) return effect->term[k].value;
    return effect->type->parameter[parameter].standard;
}
