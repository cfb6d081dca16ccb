--- Two characters who speak a line each, in two languages. Runs on any clock, so a test can play it without a window.

local lipz = require("lipz")

--- The lines, each with its speaker and the locale of its subtitles.
local LINES = {
  { key = "act1/mara-good-evening", speaker = "mara", locale = "en-us" },
  { key = "act1/otto-twenty-years", speaker = "otto", locale = "de-de" },
}
--- Silence after a line, in seconds.
local PAUSE = 0.5

local Scene = {}
Scene.__index = Scene

--- Returns the scene with the bytes of the bank `drama`. `on_event(event)` is called once for each event.
local function new(bytes, on_event)
  local bank = assert(lipz.open(bytes))
  return setmetatable({ bank = bank, on_event = on_event, line = 0, mouth = {}, face = {} }, Scene)
end

--- Starts the next line. Returns it, or nil after the last one.
function Scene:start_next()
  self.line = self.line + 1
  local line = LINES[self.line]
  self.cursor, self.locale, self.speaker, self.seconds = nil, nil, nil, 0
  if not line then return nil end
  self.cursor = assert(self.bank:clip(line.key)):cursor({ speaker = line.speaker, hold = "readable" })
  self.locale, self.speaker = self.bank:locale(line.locale), line.speaker
  return line
end

--- Advances by some seconds. A game passes the position of its audio source to the cursor instead. Returns false at the
-- end of the scene.
function Scene:update(seconds)
  if not self.cursor and not self:start_next() then return false end
  self.seconds = self.seconds + seconds
  local clip = self.cursor.clip
  for _, event in ipairs((self.cursor:advance_to(self.seconds))) do self.on_event(event) end
  clip:articulation_at(self.seconds, nil, self.mouth)
  clip:face_at(self.seconds, { speaker = self.speaker }, nil, nil, self.face)
  if self.seconds > clip:duration() + PAUSE then self.cursor = nil end
  return true
end

--- Returns the subtitle, or nil.
function Scene:subtitle() return self.cursor and self.cursor:text(self.locale) end

--- Returns what the speaker feels, or nil.
function Scene:emotion() return self.cursor and self.cursor:state(self.speaker).emotion end

return new
