--- The settings of the sample.

function love.conf(settings)
  settings.window.title = "lipz"
  settings.window.width, settings.window.height = 480, 360
  settings.modules.audio, settings.modules.physics, settings.modules.joystick = false, false, false
end
