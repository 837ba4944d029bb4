// Does this surface, or this lamp, call for an effect?

// effect: the effect's constant. 0: nobody calls for it, and its code is gone; 1: everybody does; -1: the record
// that is being shaded says so, by the effect's bit in its word `effects`. A macro: passed to a function, a constant
// would be a variable, whose value is known to nobody before the function is inlined.
#define called_for(effect, effects, bit) ((effect) > 0 || ((effect) < 0 && ((effects) & (bit)) != 0u))
