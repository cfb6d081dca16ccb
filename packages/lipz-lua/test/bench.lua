--- Measures the reader: `lua test/bench.lua`, in `packages/lipz-lua`. Prints nanoseconds and bytes of garbage for
-- each call.

package.path = "./?.lua;./?/init.lua;" .. package.path

local files = require("test.files")
local lipz = require("lipz")

local function measure(name, count, call)
  for index = 1, math.min(count, 20000) do call(index) end
  collectgarbage()
  collectgarbage("stop")
  local before, start = collectgarbage("count"), os.clock()
  for index = 1, count do call(index) end
  local seconds, kilobytes = os.clock() - start, collectgarbage("count") - before
  collectgarbage("restart")
  print(("%-34s %9.0f ns %9.1f bytes"):format(name, seconds / count * 1e9, kilobytes * 1024 / count))
end

local bytes = files.golden("drama.lipzbank")
measure("open a bank of 48 clips", 2000, function() lipz.open(bytes) end)

local bank = assert(lipz.open(bytes))
local german = bank:locale("de-de")
measure("bank:clip(key)", 100000, function() return bank:clip("act1/mara-good-evening") end)

local clip = bank:clip("act1/mara-good-evening")
local length = clip:duration()
measure("clip:viseme_at(seconds)", 1000000, function(index) return clip:viseme_at(index * 0.00015 % length) end)

local cursor = clip:cursor({ speaker = "mara", hold = "readable" })
local function tick(index)
  local seconds = index / 60 % 4
  if seconds < 1 / 60 then cursor:seek(seconds) end
  cursor:advance_to(seconds)
  return cursor:viseme(), cursor:text(german)
end
measure("tick: events, viseme, subtitle", 200000, tick)

local rigged = assert(lipz.open(files.golden("phones.lipzbank")))
local spoken, rig = rigged:clip("spoken"), rigged:rig("arkit")
local shapes, settings, influences = lipz.shapes(rig.weight_names), { out = {} }, {}
measure("tick: weights of 35 shapes", 20000, function(index)
  shapes:apply(spoken:weights_at(index / 60 % 1.4, rig, settings), influences)
end)
