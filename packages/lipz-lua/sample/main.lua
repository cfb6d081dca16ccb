--- The scene in LÖVE: `love sample`, in `packages/lipz-lua`. In your game, copy the folder `lipz` next to `main.lua`, and
-- read the bank with `love.filesystem.read("voices.lipzbank")`. With the argument `--picture FILE`, it draws the face one
-- second after the start, writes the picture, and ends.

local source = love.filesystem.getSource()
package.path = source .. "/../?.lua;" .. source .. "/../?/init.lua;" .. package.path

local new_scene = require("scene")

local scene, last_event, picture
local COLOURS = { mara = { 0.95, 0.78, 0.65 }, otto = { 0.85, 0.75, 0.6 } }

local function read_bank()
  local handle = assert(io.open(source .. "/../../../fixtures/banks/v1/drama.lipzbank", "rb"))
  local bytes = handle:read("*a")
  handle:close()
  return bytes
end

function love.load(arguments)
  scene = new_scene(read_bank(), function(event) last_event = tostring(event) end)
  if arguments[1] == "--picture" then
    picture = arguments[2]
    for _ = 1, 60 do scene:update(1 / 60) end
  end
end

function love.update(seconds)
  if not picture and not scene:update(seconds) then love.event.quit() end
end

local function draw_eye(x, face)
  love.graphics.setColor(1, 1, 1)
  love.graphics.ellipse("fill", x, 130, 22, 14 * (1 - face.blink))
  love.graphics.setColor(0.1, 0.1, 0.2)
  if face.blink < 0.8 then love.graphics.circle("fill", x - face.eye_yaw / 2, 130 - face.eye_pitch / 2, 6) end
end

local function draw_mouth(mouth)
  local width = 45 - 22 * mouth.rounding + 14 * mouth.spreading
  love.graphics.setColor(0.7, 0.25, 0.25)
  love.graphics.ellipse("fill", 240, 210 + 10 * mouth.jaw, width, 5 + 38 * mouth.opening)
  love.graphics.setColor(0.2, 0.05, 0.08)
  love.graphics.ellipse("fill", 240, 210 + 10 * mouth.jaw, width - 5, 36 * mouth.opening)
end

local function finish_picture(image)
  local file = assert(io.open(picture, "wb"))
  file:write(image:encode("png"):getString())
  file:close()
  love.event.quit()
end

function love.draw()
  if not scene.cursor then return end
  love.graphics.clear(0.15, 0.17, 0.22)
  love.graphics.push()
  love.graphics.translate(240, 160)
  love.graphics.rotate(math.rad(scene.face.head_roll))
  love.graphics.translate(-240 - scene.face.head_yaw, -160 - scene.face.head_pitch)
  love.graphics.setColor(COLOURS[scene.speaker])
  love.graphics.ellipse("fill", 240, 165, 105, 125)
  draw_eye(200, scene.face)
  draw_eye(280, scene.face)
  draw_mouth(scene.mouth)
  love.graphics.pop()
  love.graphics.setColor(1, 1, 1)
  love.graphics.printf(scene:subtitle() or "", 20, 310, 440, "center")
  love.graphics.printf(last_event or "", 10, 10, 460)
  if picture then love.graphics.captureScreenshot(finish_picture) end
end
