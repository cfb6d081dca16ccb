--- LÖVE without a window.

function love.conf(settings)
  settings.window = false
  for _, name in ipairs({ "audio", "graphics", "joystick", "physics", "sound", "touch", "video", "window" }) do
    settings.modules[name] = false
  end
end
