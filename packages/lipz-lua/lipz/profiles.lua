--- Profiles and rigs, which follow each other in a section. A damaged one ends the list.

local bytes = require("lipz.bytes")

local profiles = {}

--- Reads all profiles of a section. `read(section, at)` returns a profile, which has a `name`, and the offset after
-- it.
function profiles.list(section, read)
  local list, at = {}, 0
  while at and at < section.length do
    local profile, after = read(section, at)
    if not profile then break end
    list[#list + 1] = profile
    at = after
  end
  return list
end

--- Returns the profile with a name.
function profiles.named(list, name)
  for _, profile in ipairs(list) do
    if profile.name == name then return profile end
  end
  return nil
end

--- Adds to a class of banks the query for all profiles of a section, and the query for one of them by its name.
function profiles.add_queries(Bank, tag, all, one, read)
  Bank[all] = function(bank)
    local kept = bank.kept[tag]
    if not kept then
      kept = profiles.list(bank.sections[tag] or bytes.EMPTY, read)
      bank.kept[tag] = kept
    end
    return kept
  end
  Bank[one] = function(bank, name) return profiles.named(Bank[all](bank), name) end
end

return profiles
