--- Measures the reader: `lua test/bench.lua`, in `packages/lipz-lua`. Prints nanoseconds, the least of ten rounds, and
-- bytes of garbage for each call. The questions are those of docs/inside/ports.md.

package.path = "./?.lua;./?/init.lua;" .. package.path

local files = require("test.files")
local lipz = require("lipz")

local VERSION = jit and jit.version:match("^LuaJIT %d+%.%d+") or _VERSION
local ROUNDS = 10

local function measure(name, count, call)
  local least, most = math.huge, 0
  for index = 1, math.min(count, 20000) do call(index) end
  for _ = 1, ROUNDS do
    collectgarbage()
    collectgarbage("stop")
    local before, start = collectgarbage("count"), os.clock()
    for index = 1, count do call(index) end
    local seconds, kilobytes = os.clock() - start, collectgarbage("count") - before
    collectgarbage("restart")
    least, most = math.min(least, seconds / count * 1e9), math.max(most, kilobytes * 1024 / count)
  end
  print(("bench %s_ns %.1f %s"):format(name, least, VERSION))
  print(("bench %s_bytes %.0f %s"):format(name, most, VERSION))
end

local bytes = files.golden("drama.lipzbank")
measure("open", 500, function() lipz.open(bytes) end)

local bank = assert(lipz.open(bytes))
local german = bank:locale("de-de")
measure("clip", 20000, function() return bank:clip("act1/mara-good-evening") end)

local clip = bank:clip("act1/mara-good-evening")
measure("viseme", 200000, function(index) return clip:viseme_at(index / 60 % 4) end)

local cursor = clip:cursor({ speaker = "mara" })
measure("tick", 20000, function(index)
  local seconds = index / 60 % 4
  if seconds < 1 / 60 then cursor:seek(seconds) end
  local due = cursor:advance_to(seconds)
  return due, cursor:viseme(), cursor:text(german)
end)

local phones = assert(lipz.open(files.golden("phones.lipzbank")))
local spoken, rig = phones:clip("spoken"), phones:rig("arkit")
local shapes, settings, influences = lipz.shapes(rig.weight_names), { out = {} }, {}
measure("weights", 5000, function(index)
  shapes:apply(spoken:weights_at(index / 60 % 1.4, rig, settings), influences)
end)
